// What happened in each scan, out of counters that only grow.
#include "tools/report/profile_rungs.h"

#include <gtest/gtest.h>

#include "tests/support/count_allocations.h"

namespace {

using rung::report::ProfileCollector;

class CollectingProfile : public testing::Test {
protected:
  void ran(size_t rung, uint64_t times, uint64_t ticks) {
    counters[rung].count += times;
    counters[rung].total += ticks;
  }
  std::vector<rung_prof> counters = std::vector<rung_prof>(3);
};

TEST_F(CollectingProfile, ASampleIsWhatARungTookInAScan) {
  ProfileCollector collector(3, 0);
  ran(0, 1, 10);
  ran(1, 4, 80);
  collector.scanned(counters);
  ran(0, 1, 30);
  collector.scanned(counters);
  EXPECT_EQ(collector.scans(), 2u);
  EXPECT_EQ(collector.rungs()[0].executions, 2u);
  EXPECT_EQ(collector.rungs()[0].total, 40);
  EXPECT_EQ(collector.rungs()[0].scans, 2u);
  EXPECT_EQ(collector.rungs()[0].perScan.min(), 10u);
  EXPECT_EQ(collector.rungs()[0].perScan.max(), 30u);
  EXPECT_EQ(collector.rungs()[1].scans, 1u) << "it ran in the first scan only";
  EXPECT_EQ(collector.rungs()[1].perScan.max(), 80u);
  EXPECT_EQ(collector.rungs()[2].executions, 0u);
  EXPECT_EQ(collector.lastScan()[0], 30u);
  EXPECT_EQ(collector.lastScan()[1], 0u);
  EXPECT_EQ(collector.lastScanTotal(), 30u);
}

TEST_F(CollectingProfile, TheCostOfMeasuringIsSubtractedForEveryExecution) {
  ProfileCollector collector(3, 24.5);
  ran(0, 1, 30);
  ran(1, 4, 200);
  ran(2, 1, 20); // less than the cost: nothing, and not below
  collector.scanned(counters);
  EXPECT_EQ(collector.rungs()[0].total, 5.5);
  EXPECT_EQ(collector.rungs()[1].total, 102);
  EXPECT_EQ(collector.lastScan()[0], 6u);
  EXPECT_EQ(collector.lastScan()[1], 102u);
  EXPECT_EQ(collector.lastScan()[2], 0u);
  EXPECT_EQ(collector.rungs()[0].perScan.max(), 30u) << "a sample holds the cost of one execution";
  EXPECT_EQ(collector.rungs()[1].perScan.max(), 127u);
  EXPECT_EQ(collector.rungs()[2].perScan.max(), 20u);
  EXPECT_EQ(collector.rungs()[2].executions, 1u);
}

TEST_F(CollectingProfile, AStartIsCountedAndIsNoSample) {
  ProfileCollector collector(3, 0);
  ran(0, 2, 500);
  collector.started(counters);
  ran(0, 1, 10);
  collector.scanned(counters);
  EXPECT_EQ(collector.scans(), 1u);
  EXPECT_EQ(collector.rungs()[0].executions, 3u);
  EXPECT_EQ(collector.rungs()[0].scans, 1u);
  EXPECT_EQ(collector.rungs()[0].perScan.max(), 10u);
}

TEST_F(CollectingProfile, TakesSeveralInstancesTogether) {
  ProfileCollector collector(3, 0);
  for (int instance = 0; instance < 2; ++instance) {
    counters.assign(3, {});
    collector.started(counters);
    ran(0, 1, 10);
    collector.scanned(counters);
  }
  EXPECT_EQ(collector.rungs()[0].executions, 2u);
  EXPECT_EQ(collector.rungs()[0].perScan.count(), 2u);
}

TEST_F(CollectingProfile, ReadingCountersAllocatesNothing) {
  ProfileCollector collector(3, 20);
  const int count = rung::test::allocationsOf([&] {
    collector.started(counters);
    for (uint64_t i = 0; i < 1000; ++i) {
      counters[i % 3] = {i, i * i * i, 0, 0};
      collector.scanned(counters);
    }
  });
  EXPECT_EQ(count, 0);
}

} // namespace
