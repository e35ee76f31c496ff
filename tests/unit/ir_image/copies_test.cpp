// Copies at the borders of a task, as the table has them: those that lie side by side are one.
#include <gtest/gtest.h>

#include <string>

#include "ir/core/module.h"
#include "ir/image/program_image.h"
#include "ir/shape/layout.h"

namespace rung::ir {
namespace {

// Spaces 0 to 3 of 16 bytes, and a task with these copies.
Module moduleWith(std::vector<Copy> copies) {
  Module module;
  module.name = "copies";
  module.files = {"copies.lad"};
  for (const char* name : {"A", "B", "C", "@mask"})
    module.spaces.push_back({.name = name, .unitBytes = 1, .units = 16, .packedOnly = true});
  module.faults = {"budget"};
  module.routines.push_back({.name = "MAIN", .rungs = {Rung{}}});
  module.tasks.push_back(
      {.name = "MAIN", .entry = RoutineId{0}, .budgetFault = FaultId{0}, .begin = std::move(copies)});
  module.scan.push_back({.op = RUNG_STEP_RUN, .task = TaskId{0}, .arg = 1});
  return module;
}

Copy copy(uint32_t from, uint32_t to, uint32_t byte, uint32_t size) {
  return {.from = {.space = SpaceId{from}, .byte = byte, .size = size}, .to = SpaceId{to}, .toByte = byte};
}

// "A4+2>B4" of each, in their order.
std::string copiesOf(const Module& module) {
  const Layout layout(module, {});
  const ProgramImage image(layout, 0);
  const auto place = [&](uint32_t offset) {
    for (uint32_t s = 0; s < module.spaces.size(); ++s)
      if (const uint32_t begin = layout.memory().byte(SpaceId{s}, 0); offset >= begin && offset < begin + 16)
        return module.spaces[s].name + std::to_string(offset - begin);
    return std::string("nowhere");
  };
  std::string text;
  const rung_program& program = image.program();
  for (uint32_t i = 0; i < program.copy_count; ++i) {
    const rung_copy& c = program.copies[i];
    text += (i == 0 ? "" : " ") + place(c.from) + "+" + std::to_string(c.size) + ">" + place(c.to);
  }
  return text;
}

TEST(Copies, SideBySideAreOne) {
  EXPECT_EQ(copiesOf(moduleWith({copy(0, 1, 0, 2), copy(0, 1, 4, 3), copy(0, 1, 2, 2)})), "A0+7>B0");
  EXPECT_EQ(copiesOf(moduleWith({copy(0, 1, 0, 2), copy(0, 1, 3, 3)})), "A0+2>B0 A3+3>B3");
  EXPECT_EQ(copiesOf(moduleWith({copy(0, 1, 0, 2), copy(0, 2, 2, 2)})), "A0+2>B0 A2+2>C2");
}

TEST(Copies, OfWhatOthersWriteStayInTheirOrder) {
  EXPECT_EQ(copiesOf(moduleWith({copy(1, 2, 0, 4), copy(0, 1, 0, 2), copy(0, 1, 2, 2)})), "B0+4>C0 A0+2>B0 A2+2>B2");
  EXPECT_EQ(copiesOf(moduleWith({copy(2, 1, 0, 2), copy(0, 1, 0, 2)})), "C0+2>B0 A0+2>B0");
}

TEST(Copies, WithMasksStay) {
  Copy masked = copy(0, 1, 2, 2);
  masked.masked = true;
  masked.mask = SpaceId{3};
  masked.maskByte = 2;
  EXPECT_EQ(copiesOf(moduleWith({copy(0, 1, 4, 2), copy(0, 1, 0, 2), masked})), "A4+2>B4 A0+2>B0 A2+2>B2");
}

} // namespace
} // namespace rung::ir
