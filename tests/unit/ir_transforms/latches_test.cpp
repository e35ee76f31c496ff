// Latches that are read where they come from.
#include <gtest/gtest.h>

#include "ir/text/text.h"
#include "ir/transforms/passes.h"
#include "ir/verify/verify.h"
#include "tests/unit/ir_transforms/passes_testing.h"

namespace rung::ir {
namespace {

constexpr SpaceId kB{0}, kD{1};

// With space L, a latch of B from its byte 8 on, 16 bytes.
Module latched(const std::vector<RoutineText>& routines, const std::vector<std::string>& entries, uint32_t parts = 1) {
  std::vector<RoutineText> none = routines;
  for (RoutineText& routine : none)
    for (RungText& rung : routine.rungs) rung.lines.clear();
  Module module = moduleOf(none, entries, parts);
  module.spaces.push_back({.name = "L", .unitBytes = 1, .units = 32, .flags = RUNG_SPACE_HIDDEN});
  module.tasks[0].begin.push_back({.from = {kB, 8, 16}, .to = SpaceId{2}, .toByte = 0});
  std::string text = print(module);
  for (const RoutineText& routine : routines) {
    size_t at = text.find("routine " + routine.name + " {");
    for (const RungText& rung : routine.rungs) {
      at = text.find("weight 1 {\n", at) + 11;
      text.insert(at, rung.lines + "\n");
    }
  }
  ParseOutcome outcome = parse(text);
  EXPECT_TRUE(outcome.module) << text << outcome.error.line << ": " << outcome.error.message;
  return outcome.module ? std::move(*outcome.module) : Module{};
}

std::string afterwards(Module module, uint32_t routine = 0, uint32_t rung = 0) {
  readSourcesOfLatches(module);
  const std::vector<VerifyError> errors = verify(module, Mode::Final);
  EXPECT_TRUE(errors.empty()) << render(module, errors);
  return bodyOf(module, RoutineId{routine}, rung);
}

const std::string kRead = "%0:bit = load L[2.3]\nstore.bit D[0.0], %0";
const std::string kDirect = "%0:bit = load B[10.3]\nstore.bit D[0.0], %0\n";

std::string ofRungs(const std::vector<std::string>& rungs, uint32_t parts = 1) {
  RoutineText routine{"R", {}};
  for (const std::string& lines : rungs) routine.rungs.push_back({lines});
  return afterwards(latched({routine}, {"R"}, parts));
}

TEST(Latches, AreReadWhereTheyComeFrom) {
  EXPECT_EQ(ofRungs({kRead}), kDirect);
  EXPECT_EQ(ofRungs({"%0:i8 = load L[15]\nstore.i8 D[0], %0"}), "%0:i8 = load B[23]\nstore.i8 D[0], %0\n");
  EXPECT_EQ(ofRungs({"%0:i32 = const 1\n%1:i16 = load_at L[4 count 8], %0\nstore.i16 D[0], %1"}),
            "%0:i32 = const 1\n%1:i16 = load_at B[12 count 8], %0\nstore.i16 D[0], %1\n");
}

TEST(Latches, WhatIsNotOfTheCopyIsReadThere) {
  EXPECT_EQ(ofRungs({"%0:i16 = load L[15]\nstore.i16 D[0], %0"}), "%0:i16 = load L[15]\nstore.i16 D[0], %0\n");
  EXPECT_EQ(ofRungs({"%0:i32 = const 1\n%1:i8 = load_at L[4 count 13], %0\nstore.i8 D[0], %1"}),
            "%0:i32 = const 1\n%1:i8 = load_at L[4 count 13], %0\nstore.i8 D[0], %1\n");
}

TEST(Latches, StayWhereSomethingElseWrites) {
  const std::string kept = kRead + "\n";
  EXPECT_EQ(ofRungs({kRead, "%0:bit = load B[0.0]\nstore.bit B[9.0], %0"}), kept) << "the source";
  EXPECT_EQ(ofRungs({kRead, "%0:bit = load B[0.0]\nstore.bit L[9.0], %0"}), kept) << "the latch";
  EXPECT_EQ(ofRungs({kRead, "%0:i32 = const 1\n%1:i8 = const 2\nstore_at.i8 B[0 count 9], %0, %1"}), kept)
      << "an address that is computed";
  EXPECT_EQ(ofRungs({kRead, "%0:bit = load B[0.0]\nstore.bit B[7.0], %0"}), kDirect) << "beside it";
  EXPECT_EQ(ofRungs({kRead}, 2), kept) << "a run of two parts";
}

TEST(Latches, StayWhereACopyWrites) {
  Module module = latched({{"R", {{kRead}}}}, {"R"});
  module.tasks[0].end.push_back({.from = {kD, 0, 1}, .to = kB, .toByte = 8});
  EXPECT_EQ(afterwards(module), kRead + "\n") << "over the source";
  module.tasks[0].end.back().to = SpaceId{2};
  EXPECT_EQ(afterwards(module), kRead + "\n") << "over the latch";
  module.tasks[0].end.back() = {.masked = true, .from = {kD, 0, 1}, .to = kD, .toByte = 8, .mask = kB, .maskByte = 8};
  EXPECT_EQ(afterwards(module), kRead + "\n") << "an emptied mask";
  module.tasks[0].end.back().maskByte = 7;
  EXPECT_EQ(afterwards(module), kDirect);
  module.tasks[0].begin[0].masked = true;
  module.tasks[0].begin[0].mask = kD;
  EXPECT_EQ(afterwards(module), kRead + "\n") << "only what is marked";
}

TEST(Latches, AreOfOneTask) {
  const std::vector<RoutineText> routines = {{"R", {{kRead}, {"", "} call S"}}}, {"Q", {{kRead}}}, {"S", {{kRead}}}};
  EXPECT_EQ(afterwards(latched(routines, {"R", "Q"}), 0), kDirect);
  EXPECT_EQ(afterwards(latched(routines, {"R", "Q"}), 1), kRead + "\n") << "the other task reads what was latched";
  EXPECT_EQ(afterwards(latched(routines, {"R", "Q"}), 2), kDirect);
  EXPECT_EQ(afterwards(latched(routines, {"R", "S"}), 2), kRead + "\n") << "both tasks run it";
}

TEST(Latches, ThatNobodyReadsAreNotCopied) {
  const auto copies = [](Module module) {
    readSourcesOfLatches(module);
    return module.tasks[0].begin.size();
  };
  const Module module = latched({{"R", {{kRead}}}}, {"R"});
  EXPECT_EQ(copies(module), 0u);
  Module other = module;
  other.retains.push_back({SpaceId{2}, 15, 1});
  EXPECT_EQ(copies(other), 1u) << "somebody keeps it";
  other = module;
  other.tasks[0].end.push_back({.from = {SpaceId{2}, 15, 1}, .to = kD});
  EXPECT_EQ(copies(other), 1u) << "it is copied on";
  EXPECT_EQ(copies(latched({{"R", {{kRead}}}, {"Q", {{kRead}}}}, {"R", "Q"})), 1u) << "another task reads it";
  EXPECT_EQ(copies(latched({{"R", {{"%0:i16 = load L[15]\nstore.i16 D[0], %0"}}}}, {"R"})), 1u);
}

TEST(Latches, OfOtherUnitsOrWithANameStay) {
  Module module = latched({{"R", {{kRead}}}}, {"R"});
  module.spaces[2].flags = 0;
  EXPECT_EQ(afterwards(module), kRead + "\n");
  module.spaces[2] = {.name = "L", .unitBytes = 4, .units = 8, .flags = RUNG_SPACE_HIDDEN};
  EXPECT_NE(afterwards(module).find("load L["), std::string::npos);
}

} // namespace
} // namespace rung::ir
