// Times of scans, slices and tasks: the shortest of all runs, and what is compared with which period.
#include "tools/report/scan_times.h"

#include <gtest/gtest.h>

#include "rtlib/core/ticks.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::report;
using rung::runtime::Instance;
using rung::test::TestProgram;

TEST(ProfileShortest, KeepsTheShortestOfEachPiece) {
  Shortest shortest;
  for (const uint64_t ticks : {30, 900, 10}) shortest.add(ticks); // the second was disturbed
  shortest.rewind();
  for (const uint64_t ticks : {700, 20, 11}) shortest.add(ticks); // the first
  EXPECT_EQ(shortest.values(), (std::vector<uint64_t>{30, 20, 10}));
}

TEST(ProfileSpread, OfValues) {
  EXPECT_EQ(spreadOf({}, 1).count, 0u);
  std::vector<uint64_t> values;
  for (uint64_t i = 1; i <= 101; ++i) values.push_back(i);
  const Spread spread = spreadOf(values, 2);
  EXPECT_EQ(spread.count, 101u);
  EXPECT_EQ(spread.min, 2);
  EXPECT_EQ(spread.mean, 102);
  EXPECT_EQ(spread.median, 102);
  EXPECT_EQ(spread.p99, 200);
  EXPECT_EQ(spread.max, 202);
}

void busy(uint64_t ticks) {
  const uint64_t start = rung::core::readTicks();
  while (rung::core::readTicks() - start < ticks) {
  }
}

// Two slices of 8 ms: a short fast task in each, a longer main task in the second.
class ProfileScanTimes : public testing::Test {
protected:
  ProfileScanTimes() {
    test.addChunk([](uint8_t*, rung_ctx*, uint32_t) {
      busy(20'000);
      return RUNG_PC_DONE;
    });
    test.addChunk([](uint8_t*, rung_ctx*, uint32_t) {
      busy(2'000'000);
      return RUNG_PC_DONE;
    });
    fast = test.addTask("FAST", 0);
    main = test.addTask("MAIN", 1);
    test.tasks[main].period_us = 16000;
    test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_RUN, fast, 1}, {RUNG_STEP_HOOK, RUNG_NONE, 1},
                 {RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_RUN, fast, 1}, {RUNG_STEP_RUN, main, 1}};
    test.link();
  }
  TestProgram test;
  uint32_t fast = 0;
  uint32_t main = 0;
};

TEST_F(ProfileScanTimes, EachAgainstItsOwnPeriod) {
  struct SlowNc : rung::runtime::ScheduleHooks {
    void onHook(Instance&, uint32_t) override { busy(10'000'000); }
  } nc;
  Instance instance(test.program, &nc);
  ScanTimes times;
  instance.setTaskWatch(&times);
  for (int run = 0; run < 3; ++run) {
    times.rewind();
    times.started(instance);
    for (int i = 0; i < 4; ++i) {
      instance.scan();
      times.scanned(true);
    }
    instance.fast(); // does nothing here: no scan
    times.scanned(false);
  }
  const std::vector<Deadline> deadlines = times.deadlines(test.program, {1.0, 0});
  ASSERT_EQ(deadlines.size(), 4u);
  EXPECT_EQ(deadlines[0].name, "whole scan");
  EXPECT_EQ(deadlines[0].periodUs, 16000);
  EXPECT_EQ(deadlines[0].ns.count, 4u);
  EXPECT_GE(deadlines[0].ns.median, 2'039'000);
  EXPECT_LT(deadlines[0].ns.min, 10'000'000) << "the NC's own time does not count";
  EXPECT_EQ(deadlines[1].name, "time slice");
  EXPECT_EQ(deadlines[1].periodUs, 8000);
  EXPECT_EQ(deadlines[1].ns.count, 8u);
  EXPECT_LT(deadlines[1].ns.min, 2'000'000);
  EXPECT_GE(deadlines[1].ns.max, 2'019'000);
  EXPECT_EQ(deadlines[2].name, "FAST");
  EXPECT_EQ(deadlines[2].periodUs, 8000);
  EXPECT_EQ(deadlines[2].ns.count, 8u);
  EXPECT_EQ(deadlines[3].name, "MAIN");
  EXPECT_EQ(deadlines[3].periodUs, 16000);
  EXPECT_EQ(deadlines[3].ns.count, 4u);
}

TEST_F(ProfileScanTimes, PeriodOfASlice) {
  EXPECT_EQ(slicePeriodUs(test.program), 8000u);
  test.scan = {{RUNG_STEP_RUN, 0, 1}}; // without an ADVANCE it is the main task's
  test.link();
  EXPECT_EQ(slicePeriodUs(test.program), 8000u);
}

} // namespace
