// Which chunks have rows of alike rungs.
#include "ir/chunks/alike_rungs.h"

#include <gtest/gtest.h>

#include "ir/core/builder.h"

namespace rung::ir {
namespace {

constexpr SpaceId kBits{0};

Module empty(uint32_t rungs) {
  Module m;
  m.spaces.push_back({.name = "B", .unitBytes = 1, .units = 64});
  m.routines.push_back({.name = "MAIN", .rungs = std::vector<Rung>(rungs)});
  m.tasks.push_back(
      {.name = "MAIN", .entry = {0}, .periodUs = 1000, .budgetFault = {}, .begin = {}, .end = {}, .borders = {}});
  m.mainTask = {0};
  return m;
}

void copyBit(Module& m, uint32_t rung, bool inverted) {
  RungBuilder b(m, m.routines[0].rungs[rung]);
  const ValueId bit = b.load(Type::Bit, {kBits, rung, 0});
  b.store({kBits, rung, 1}, inverted ? b.not_(bit) : bit);
}

bool found(const Module& m) {
  const Cut cut(m, {});
  return hasAlikeRungs(m, cut.chunks()[0]);
}

TEST(AlikeRungs, ARowOfThemIsFound) {
  Module m = empty(20);
  for (uint32_t i = 0; i < 20; ++i) copyBit(m, i, false);
  EXPECT_TRUE(found(m));
}

TEST(AlikeRungs, ARowThatIsInterruptedIsShort) {
  Module m = empty(15);
  for (uint32_t i = 0; i < 15; ++i) copyBit(m, i, i == 7);
  EXPECT_FALSE(found(m));
}

TEST(AlikeRungs, GroupsOfRungsAreComparedAsGroups) {
  Module m = empty(48);
  for (uint32_t i = 0; i < 48; ++i) copyBit(m, i, i % 3 == 0);
  EXPECT_TRUE(found(m));
}

TEST(AlikeRungs, ARungThatJumpsEndsARow) {
  Module m = empty(15);
  for (uint32_t i = 0; i < 15; ++i) copyBit(m, i, false);
  m.routines[0].rungs[7].transfer = {.kind = TransferKind::Goto, .cond = {0}, .target = 14};
  EXPECT_FALSE(found(m));
}

} // namespace
} // namespace rung::ir
