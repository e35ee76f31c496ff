// Of every GoogleTest program. What was skipped must not count as passed: the exit status says it (SKIP_RETURN_CODE in
// cmake/suites.cmake), unless something has failed as well.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

int main(int argc, char** argv) {
  constexpr int kSkipped = 77;
  testing::InitGoogleMock(&argc, argv);
  const int failed = RUN_ALL_TESTS();
  const bool skipped = testing::UnitTest::GetInstance()->skipped_test_count() > 0;
  return failed == 0 && skipped ? kSkipped : failed;
}
