// What the harness of goldens fails for, and what RUNG_UPDATE=1 does about it.
#include "tests/support/cases.h"
#include "tests/support/golden.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "ir/support/temporary_folder.h"
#include "tests/support/words.h"

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

// A file of cases, in which each input becomes itself in brackets.
class CasesTest : public testing::Test {
protected:
  CasesTest() { unsetenv("RUNG_UPDATE"); }
  ~CasesTest() override { unsetenv("RUNG_UPDATE"); }

  void run(const char* text) {
    std::ofstream(files / "all.cases") << text;
    Golden golden(files / "", {".cases"});
    rung::test::expectCases(golden, golden.inputs().at(0),
                            [](const rung::test::Case& one) { return one.input.empty() ? "" : "[" + one.input + "]"; });
  }

  rung::TemporaryFolder files;
};

TEST_F(CasesTest, HaveWhatTheirInputsBecome) {
  run("=== one\na\nb\n---\n[a\nb]\n\n=== nothing\n\n---\n\n=== an end of a line\nc\n\n---\n[c\n]\n");
}

TEST_F(CasesTest, AnotherOutcomeFails) {
  EXPECT_NONFATAL_FAILURE(run("=== one\na\n---\n[b]\n"), "all.cases");
  EXPECT_NONFATAL_FAILURE(run("=== one\na\n---\n"), "all.cases");
}

TEST_F(CasesTest, ANewOneIsWrittenWithItsOutcome) {
  setenv("RUNG_UPDATE", "1", 1);
  run("=== one\na\n---\n=== two\nb\n---\nas it was\n");
  EXPECT_EQ(files.contentsOf("all.cases"), "=== one\na\n---\n[a]\n\n=== two\nb\n---\n[b]\n");
}

TEST_F(CasesTest, FilesWithoutTheirFormAreRefused) {
  for (const char* wrong :
       {"", "a\n", "=== one\na\n", "=== one\na\n=== two\nb\n---\n", "=== one\na\n---\n=== one\nb\n---\n"})
    EXPECT_THROW(run(wrong), std::runtime_error) << wrong;
}

TEST(Words, ThatATextLacks) {
  EXPECT_EQ(rung::test::lacking("t:3:1: 'a' is not b", {"t:3:1: ", "'a'", "b"}), "");
  EXPECT_EQ(rung::test::lacking("a b", {"b", "a"}), "no 'a' in: a b") << "in this order";
}

} // namespace
