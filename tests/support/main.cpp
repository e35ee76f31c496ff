// Of every GoogleTest program: they find files by their path in the repository, from whatever folder they are started.
#include <gtest/gtest.h>

#include <filesystem>
#include <system_error>

int main(int argc, char** argv) {
  std::error_code elsewhere; // on a machine without the sources, where only some tests can be run
  std::filesystem::current_path(RUNG_TEST_ROOT, elsewhere);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
