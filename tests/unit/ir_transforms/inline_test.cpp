// Routines with one caller: where their rungs come to lie, and what becomes of calls and paths back.
#include <gtest/gtest.h>

#include "ir/text/text.h"
#include "ir/transforms/passes.h"
#include "ir/verify/verify.h"
#include "tests/unit/ir_transforms/passes_testing.h"

namespace rung::ir {
namespace {

const std::string kBit = "%0:bit = load B[0.0]\n";
const std::string kStore = "%0:bit = load B[0.0]\nstore.bit B[0.1], %0\n"; // so that rungs of callees are known

Module inlined(const std::vector<RoutineText>& routines, const std::vector<std::string>& entries = {"R"},
               uint32_t parts = 1) {
  Module module = moduleOf(routines, entries, parts);
  inlineRoutines(module);
  const std::vector<VerifyError> errors = verify(module, Mode::Built);
  EXPECT_TRUE(errors.empty()) << render(module, errors);
  return module;
}

// A rung a line: the routine that it stands in, and its body.
std::string rungsOf(const Module& module, uint32_t routine = 0) {
  std::string out;
  for (uint32_t i = 0; i < module.routines[routine].rungs.size(); ++i) {
    const Rung& rung = module.routines[routine].rungs[i];
    std::string body = bodyOf(module, RoutineId{routine}, i);
    for (char& c : body)
      if (c == '\n') c = ' ';
    out += homeOf(module.routines[routine], rung) + ": " + body + "\n";
  }
  return out;
}

TEST(Inline, TakesThePlaceOfTheCall) {
  const Module module = inlined({{"R", {{"", "} call S"}, {kStore}}}, {"S", {{kBit, "} ret if %0"}, {"", "} ret"}}}});
  EXPECT_EQ(module.routines.size(), 1u);
  EXPECT_EQ(rungsOf(module), "R: \n"
                             "S: %0:bit = load B[0.0] } goto 3 if %0 \n"
                             "S: \n" // the way back is to the rung below
                             "R: %0:bit = load B[0.0] store.bit B[0.1], %0 \n");
}

TEST(Inline, ACallWithAConditionLeapsOverIt) {
  const Module module = inlined({{"R", {{kBit, "} call S if %0"}, {"", "} goto 0"}}}, {"S", {{""}, {"", "} goto 0"}}}});
  EXPECT_EQ(rungsOf(module), "R: %0:bit = load B[0.0] %1:bit = not %0 } goto 3 if %1 \n"
                             "S: \n"
                             "S: } goto 1 \n"
                             "R: } goto 0 \n");
}

TEST(Inline, BehindTheLastRungOneGoesBack) {
  const Module module = inlined({{"R", {{kBit, "} call S if %0"}}}, {"S", {{kBit, "} ret if %0"}, {kStore}}}});
  EXPECT_EQ(rungsOf(module), "R: %0:bit = load B[0.0] %1:bit = not %0 } ret if %1 \n"
                             "S: %0:bit = load B[0.0] } ret if %0 \n"
                             "S: %0:bit = load B[0.0] store.bit B[0.1], %0 \n");
}

TEST(Inline, OneWithinTheOther) {
  const Module module = inlined({{"U", {{kStore, "} ret"}, {""}}},
                                 {"R", {{"", "} call S"}, {"", "} end"}}},
                                 {"S", {{"", "} call U"}, {"", "} ret"}}}});
  EXPECT_EQ(module.routines.size(), 1u);
  EXPECT_EQ(rungsOf(module), "R: \n"
                             "S: \n"
                             "U: %0:bit = load B[0.0] store.bit B[0.1], %0 } goto 4 \n"
                             "U: \n"
                             "S: \n"
                             "R: } end \n");
}

TEST(Inline, NotWhatSeveralCallOrATaskBegins) {
  const std::vector<RoutineText> twice = {{"S", {{""}}}, {"R", {{"", "} call S"}, {"", "} call S"}}}};
  EXPECT_EQ(print(inlined(twice)), print(moduleOf(twice, {"R"})));
  const std::vector<RoutineText> entry = {{"R", {{"", "} call S"}}}, {"S", {{""}}}};
  EXPECT_EQ(print(inlined(entry, {"R", "S"})), print(moduleOf(entry, {"R", "S"})));
}

TEST(Inline, BordersOfPartsStayWhereTheyAre) {
  Module module = moduleOf({{"R", {{"", "} call S"}, {kStore}, {""}}}, {"S", {{""}, {""}}}}, {"R"}, 3);
  module.tasks[0].borders = {1, 2};
  inlineRoutines(module);
  EXPECT_EQ(module.tasks[0].borders, (std::vector<uint32_t>{3, 4}));
}

} // namespace
} // namespace rung::ir
