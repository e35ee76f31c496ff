// A scan in fewer steps: what is joined. That a runner does the same with them is runner_test.cpp's matter.
#include "rtlib/core/scan_steps.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rung::core {
namespace {

using Steps = std::vector<rung_step>;

constexpr rung_step advance(uint32_t us) { return {RUNG_STEP_ADVANCE, RUNG_NONE, us}; }
constexpr rung_step run(uint32_t task, uint32_t times = 1) { return {RUNG_STEP_RUN, task, times}; }
constexpr rung_step hook(uint32_t work) { return {RUNG_STEP_HOOK, RUNG_NONE, work}; }
constexpr rung_step kSlot = {RUNG_STEP_SLOT, RUNG_NONE, 0};

std::string text(const Steps& steps) {
  std::string out;
  for (const rung_step& step : steps)
    out += "ARPHS"[step.op] + (step.task == RUNG_NONE ? "" : std::to_string(step.task) + "*") +
           std::to_string(step.arg) + " ";
  return out;
}

std::string joined(const Steps& steps, uint32_t works = 0) {
  Steps out(steps.size());
  out.resize(joinSteps(steps, works, out.data()));
  return text(out);
}

TEST(PassSteps, TimesAndRunsWithNothingBetween) {
  EXPECT_EQ(joined({advance(2000), hook(0), advance(2000), hook(0), run(0)}), "A4000 R0*1 ");
  EXPECT_EQ(joined({run(1), hook(3), run(1, 4), run(0), run(1)}), "R1*5 R0*1 R1*1 ");
  EXPECT_EQ(joined({}), "");
  EXPECT_EQ(joined({hook(0), hook(31)}), "");
}

TEST(PassSteps, WhatHasWorkStaysBetween) {
  EXPECT_EQ(joined({advance(2000), hook(0), advance(2000), hook(1), run(0)}, 0b10), "A4000 H1 R0*1 ");
  EXPECT_EQ(joined({run(0), hook(32), run(0)}), "R0*1 H32 R0*1 "); // has no bit: always work
  EXPECT_EQ(joined({advance(8), kSlot, advance(8), kSlot}), "A8 S0 A8 S0 ");
  EXPECT_EQ(joined({{RUNG_STEP_PART, 0, 0}, {RUNG_STEP_PART, 0, 0}}), "P0*0 P0*0 ");
}

TEST(PassSteps, SumsThatFitAlone) {
  EXPECT_EQ(joined({advance(UINT32_MAX), advance(1)}), "A4294967295 A1 ");
  EXPECT_EQ(joined({run(0, UINT32_MAX - 1), run(0, 1), run(0, 1)}), "R0*4294967295 R0*1 ");
}

} // namespace
} // namespace rung::core
