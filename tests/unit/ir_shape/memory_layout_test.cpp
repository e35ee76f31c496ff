// Where a program's memory lies when the program changes.
#include <gtest/gtest.h>

#include <string>

#include "ir/core/module.h"
#include "ir/shape/memory_layout.h"

namespace rung::ir {
namespace {

// A dialect's space, a hidden one, and slots.
Module moduleWith(uint32_t slots) {
  Module module;
  module.spaces.push_back({.name = "R", .unitBytes = 1, .units = 100, .packedOnly = true});
  module.spaces.push_back(
      {.name = "@table", .unitBytes = 1, .units = 10, .flags = RUNG_SPACE_HIDDEN, .packedOnly = true});
  for (uint32_t i = 0; i < slots; ++i) module.slots.push_back({.type = Type::I32, .key = std::to_string(i)});
  return module;
}

// So that a program that takes over finds the state in place.
TEST(MemoryLayout, AFewMoreSlotsMoveNothingElse) {
  const Module former = moduleWith(40), next = moduleWith(100);
  const MemoryLayout before(former, true), after(next, true);
  for (const SpaceId space : {SpaceId{0}, SpaceId{1}}) EXPECT_EQ(before.byte(space, 0), after.byte(space, 0));
  EXPECT_EQ(before.slot(SlotId{39}), after.slot(SlotId{39}));
}

} // namespace
} // namespace rung::ir
