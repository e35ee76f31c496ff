// Branch weights of ifs from counts of earlier runs.
#include "ir/analysis/branch_weights.h"

#include <gtest/gtest.h>

#include "tests/unit/ir_transforms/passes_testing.h"

namespace rung::ir {
namespace {

constexpr uint64_t kKey = 7;

// Three ifs, one within the other and one after it.
Module threeIfs() {
  Module module = moduleOf(R"(%0:bit = load B[0.0]
if %0
%1:bit = load B[0.1]
if %1
store.bit B[0.2], %0
endif
endif
if %0
endif)");
  module.routines[0].rungs[0].key = kKey;
  return module;
}

TEST(BranchWeights, SayHowOftenConditionsAreOne) {
  Module module = threeIfs();
  const BranchWeightsResult result = setBranchWeights(module, {{kKey, {{1000, 950}, {950, 95}, {1000, 500}}}});
  EXPECT_EQ(result.known, 1u);
  EXPECT_EQ(result.unknown, 0u);
  EXPECT_EQ(bodyOf(module), R"(%0:bit = load B[0.0]
if mostly, %0
%1:bit = load B[0.1]
if seldom, %1
store.bit B[0.2], %0
endif
endif
if %0
endif
)");
}

TEST(BranchWeights, OneIfInTenIsRare) {
  Module module = threeIfs();
  setBranchWeights(module, {{kKey, {{100, 90}, {100, 89}, {0, 0}}}});
  EXPECT_EQ(bodyOf(module), R"(%0:bit = load B[0.0]
if mostly, %0
%1:bit = load B[0.1]
if %1
store.bit B[0.2], %0
endif
endif
if seldom, %0
endif
)");
}

TEST(BranchWeights, CountsOfAnotherRungAreNotTaken) {
  Module module = threeIfs();
  const std::string before = bodyOf(module);
  const BranchCounts other{{kKey, {{1000, 0}}}, {kKey + 1, {{1, 0}, {1, 0}, {1, 0}}}};
  const BranchWeightsResult result = setBranchWeights(module, other);
  EXPECT_EQ(result.known, 0u);
  EXPECT_EQ(result.unknown, 1u);
  EXPECT_EQ(bodyOf(module), before);
}

} // namespace
} // namespace rung::ir
