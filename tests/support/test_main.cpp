// Of every GoogleTest program. Files are found by their path in the repository, from whatever folder it is started.
// What was skipped must not count as passed: the exit status says it (SKIP_RETURN_CODE in cmake/suites.cmake), unless
// something has failed as well.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <system_error>

int main(int argc, char** argv) {
  constexpr int kSkipped = 77;
  std::error_code elsewhere; // on a machine without the sources, where only some tests can be run
  std::filesystem::current_path(RUNG_TEST_ROOT, elsewhere);
  testing::InitGoogleMock(&argc, argv);
  const int failed = RUN_ALL_TESTS();
  const bool skipped = testing::UnitTest::GetInstance()->skipped_test_count() > 0;
  return failed == 0 && skipped ? kSkipped : failed;
}
