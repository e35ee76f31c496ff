// Which values of a long rung go through memory.
#include "ir/core/regions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ir/core/builder.h"
#include "ir/core/ops.h"

namespace rung::ir {
namespace {

// A line of contacts before a coil.
Rung lineOf(Module& module, uint32_t contacts) {
  module.spaces.push_back({.name = "M", .units = contacts});
  Rung rung;
  RungBuilder b(module, rung);
  ValueId power = b.load(Type::Bit, {SpaceId{0}, 0});
  for (uint32_t i = 1; i < contacts; ++i) power = b.and_(power, b.load(Type::Bit, {SpaceId{0}, i}));
  b.store({SpaceId{0}, 0}, power);
  return rung;
}

TEST(LongRungs, ChainsEndAtTheBordersOfStretches) {
  Module module;
  const Rung rung = lineOf(module, 10'000);
  ASSERT_TRUE(isLong(rung));
  const std::vector<bool> through = valuesThroughMemory(rung);
  ASSERT_EQ(through.size(), rung.values.size());
  EXPECT_EQ(std::ranges::count(through, true), static_cast<ptrdiff_t>((rung.ops.size() - 1) / kStretch));
  for (const Op& op : rung.ops) {
    if (op.resultCount == 0 || !through[op.result.index]) continue;
    EXPECT_EQ(op.code, OpCode::And); // what is read is in no chain
  }
}

TEST(LongRungs, OthersHaveNone) {
  Module module;
  const Rung rung = lineOf(module, 1'000);
  EXPECT_FALSE(isLong(rung));
  EXPECT_TRUE(valuesThroughMemory(rung).empty());
}

} // namespace
} // namespace rung::ir
