// What the goldens' harness fails for, and what RUNG_UPDATE=1 does about it.
#include "tests/support/golden.h"

#include <gmock/gmock.h>
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "ir/support/temporary_folder.h"

namespace {

using rung::test::Golden;

class GoldenTest : public testing::Test {
protected:
  GoldenTest() {
    unsetenv("RUNG_UPDATE");
    write("a.in", "a");
    write("a.out", "A");
  }
  ~GoldenTest() override { unsetenv("RUNG_UPDATE"); }

  void write(const char* name, const char* text) { std::ofstream(files / name) << text; }
  // Every input becomes `text`.
  void run(const char* text) {
    Golden golden(files / "", {".in"});
    for (const auto& input : golden.inputs()) golden.expect(input, ".out", text);
  }

  rung::TemporaryFolder files;
};

TEST_F(GoldenTest, WhatIsAsItWasPasses) { run("A"); }

TEST_F(GoldenTest, AnotherTextFails) {
  EXPECT_NONFATAL_FAILURE(
      {
        Golden golden(files / "", {".in"});
        golden.expect("a.out", "B");
      },
      "a.out");
}

TEST_F(GoldenTest, AStaleFileFails) {
  write("gone.out", "");
  EXPECT_NONFATAL_FAILURE(
      {
        Golden golden(files / "", {".in"});
        golden.expect("a.out", "A");
      },
      "gone.out");
}

TEST_F(GoldenTest, AFolderWithoutInputsFails) {
  EXPECT_NONFATAL_FAILURE(Golden("tests/no/such/folder", {".in"}), "has no inputs");
}

TEST_F(GoldenTest, UpdatingWritesAndRemoves) {
  write("b.in", "b");
  write("gone.out", "");
  setenv("RUNG_UPDATE", "1", 1);
  run("B");
  unsetenv("RUNG_UPDATE");
  EXPECT_EQ(files.contentsOf("a.out"), "B");
  EXPECT_EQ(files.contentsOf("b.out"), "B");
  EXPECT_EQ(files.contentsOf("gone.out"), std::nullopt);
  run("B");
}

} // namespace
