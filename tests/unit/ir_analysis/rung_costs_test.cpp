// How often a rung does an operation at most.
#include "ir/analysis/rung_costs.h"

#include <gtest/gtest.h>

#include "ir/core/ops.h"
#include "tests/random/random.h"

namespace rung::ir {
namespace {

uint64_t mostMessages(std::vector<Op> ops) {
  Module module = randomModule(1, {.routines = 1, .rungs = 4, .jumps = false});
  Rung& first = module.routines[0].rungs[0];
  first = {};
  first.ops = std::move(ops);
  return mostOperations(Partition(module, {}), OpCode::Message)[0];
}

constexpr Op kMessage{.code = OpCode::Message};
constexpr Op kIf{.code = OpCode::If};
constexpr Op kElse{.code = OpCode::Else};
constexpr Op kEndIf{.code = OpCode::EndIf};
constexpr Op kEndLoop{.code = OpCode::EndLoop};
constexpr Op loop(uint32_t rounds) { return {.code = OpCode::Loop, .count = rounds}; }

TEST(MostOperations, OfTheBranchWithMore) {
  EXPECT_EQ(mostMessages({kMessage, kIf, kMessage, kMessage, kElse, kMessage, kEndIf}), 3u);
  EXPECT_EQ(mostMessages({kIf, kElse, kMessage, kEndIf, kMessage}), 2u);
  EXPECT_EQ(mostMessages({kIf, kMessage, kEndIf, kIf, kMessage, kEndIf}), 2u);
}

TEST(MostOperations, OfAllRounds) {
  EXPECT_EQ(mostMessages({loop(5), kMessage, kIf, kMessage, kEndIf, kEndLoop, kMessage}), 11u);
  EXPECT_EQ(mostMessages({loop(5), kMessage, loop(3), kMessage, kEndLoop, kEndLoop}), 20u);
  EXPECT_EQ(mostMessages({loop(0), kMessage, kEndLoop}), 0u);
}

TEST(MostOperations, AtMostWhatACounterHolds) {
  const Op most = loop(UINT32_MAX);
  EXPECT_EQ(mostMessages({most, most, most, kMessage, kEndLoop, kEndLoop, kEndLoop, kMessage}), UINT64_MAX);
}

TEST(MostOperations, OfOthersNone) { EXPECT_EQ(mostMessages({{.code = OpCode::ServicePoll}}), 0u); }

} // namespace
} // namespace rung::ir
