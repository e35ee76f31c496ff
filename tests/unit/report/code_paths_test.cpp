// The longest path through graphs of machine code.
#include "codegen/jit/code_paths.h"

#include <gtest/gtest.h>

#include <utility>

namespace rung::codegen {
namespace {

CodeLength lengthOf(FunctionCode code) { return CodeLengths({{"F", std::move(code)}}).of("F"); }

TEST(CodePaths, TakeTheLongerBranch) {
  EXPECT_EQ(lengthOf({.blocks = {{.instructions = 2, .next = {1, 2}},
                                 {.instructions = 10, .next = {3}},
                                 {.instructions = 3, .next = {3}},
                                 {.instructions = 1}}})
                .instructions,
            13u);
}

TEST(CodePaths, RepeatLoopsAndTheirInnerLoops) {
  // 0 -> 1 (header, 5 rounds) -> 2 (inner loop by itself, 3 rounds) -> 1 or 3
  const FunctionCode code{.blocks = {{.instructions = 1, .next = {1}},
                                     {.instructions = 2, .next = {2}, .loop = 0},
                                     {.instructions = 4, .next = {2, 1, 3}, .loop = 1},
                                     {.instructions = 7}},
                          .loops = {{.header = 1, .rounds = 5}, {.header = 2, .parent = 0, .rounds = 3}}};
  EXPECT_EQ(lengthOf(code).instructions, 1u + 5 * (2 + 3 * 4) + 7);
}

TEST(CodePaths, SayWhyThereIsNoBound) {
  FunctionCode endless{.blocks = {{.instructions = 1, .next = {0}, .loop = 0}}, .loops = {{.header = 0}}};
  EXPECT_EQ(lengthOf(endless).unknown, "a loop has no constant bound");
  const FunctionCode irregular{.blocks = {{.instructions = 1, .next = {1, 2}},
                                          {.instructions = 1, .next = {2}},
                                          {.instructions = 1, .next = {1}}}};
  EXPECT_EQ(lengthOf(irregular).unknown, "control enters a loop of the machine code in two places");
  EXPECT_EQ(lengthOf({.blocks = {{.instructions = 1, .calls = {"memset"}}}}).unknown,
            "it calls 'memset', whose code is not known");
  EXPECT_EQ(lengthOf({.blocks = {{.instructions = 1, .calls = {"F"}}}}).unknown, "'F' calls itself");
}

TEST(CodePaths, AddWhatIsCalled) {
  CodeLengths lengths(
      {{"F", {.blocks = {{.instructions = 2, .calls = {"G", "G"}}}}}, {"G", {.blocks = {{.instructions = 5}}}}});
  EXPECT_EQ(lengths.of("F").instructions, 12u);
}

} // namespace
} // namespace rung::codegen
