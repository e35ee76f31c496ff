// The figures of a scan thread: what steps show of themselves.
#include "machine/rung-run/scan_thread.h"

#include <gtest/gtest.h>

#include <thread>

namespace rung::rung_run {
namespace {

constexpr int64_t kMs = 1'000'000;

TEST(StepTimes, BeginWithNothing) {
  const StepFigures now = StepTimes().figures();
  EXPECT_EQ(now.steps, 0u);
  EXPECT_EQ(now.shortestPeriodNs, 0);
  EXPECT_TRUE(now.worst.empty());
}

TEST(StepTimes, HaveTheExtremesAndTheMean) {
  StepTimes times;
  times.add({.beginNs = kMs, .periodNs = kMs, .lateNs = 3000, .tookNs = 5000}, false);
  times.add({.beginNs = 2 * kMs, .periodNs = kMs + 9000, .lateNs = 12000, .tookNs = 9000}, false);
  times.add({.beginNs = 5 * kMs, .periodNs = kMs - 9000, .lateNs = 2 * kMs, .tookNs = 1000}, true);
  const StepFigures now = times.figures();
  EXPECT_EQ(now.steps, 3u);
  EXPECT_EQ(now.overruns, 1u);
  EXPECT_EQ(now.shortestPeriodNs, kMs - 9000);
  EXPECT_EQ(now.longestPeriodNs, kMs + 9000);
  EXPECT_EQ(now.latestNs, 2 * kMs);
  EXPECT_EQ(now.meanNs, 5000);
}

TEST(StepTimes, KeepTheThreeLongestSteps) {
  StepTimes times;
  for (const int64_t took : {30, 10, 50, 20, 40}) times.add({.beginNs = took * kMs, .tookNs = took}, false);
  const std::vector<StepFigures::Worst> worst = times.figures().worst;
  ASSERT_EQ(worst.size(), 3u);
  EXPECT_EQ(worst[0].tookNs, 50);
  EXPECT_EQ(worst[0].beginNs, 50 * kMs);
  EXPECT_EQ(worst[1].tookNs, 40);
  EXPECT_EQ(worst[2].tookNs, 30);
}

TEST(StepTimes, LimitTheLatenessOfMost) {
  StepTimes times;
  for (int64_t i = 1; i <= 10000; ++i) times.add({.lateNs = i * 100}, false);
  const StepFigures now = times.figures();
  EXPECT_GE(now.late99Ns, 990'000);
  EXPECT_LE(now.late99Ns, 990'000 * 5 / 4);
  EXPECT_GE(now.late999Ns, 999'000);
  EXPECT_LE(now.late999Ns, now.latestNs);
}

TEST(StepTimes, TakeEveryLateness) {
  StepTimes times;
  for (const int64_t late : {INT64_C(-5), INT64_C(0), INT64_C(3), INT64_C(4), INT64_MAX})
    times.add({.lateNs = late}, false);
  EXPECT_EQ(times.figures().steps, 5u);
  EXPECT_EQ(times.figures().late999Ns, 5) << "four of five: 4 ns is the last of them, in a class that ends at 5";
}

TEST(StepTimes, AreReadWhileTheyAreCounted) {
  StepTimes times;
  std::thread counting([&times] {
    for (int64_t i = 0; i < 100'000; ++i) times.add({.beginNs = i, .periodNs = kMs, .lateNs = i, .tookNs = i}, false);
  });
  uint64_t before = 0;
  while (before < 100'000) {
    const StepFigures now = times.figures();
    EXPECT_GE(now.steps, before);
    before = now.steps;
  }
  counting.join();
}

} // namespace
} // namespace rung::rung_run
