// The loop on the machine's clock. Bounds are loose: the machine may be busy.
#include "rtlib/host/realtime.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::host;
using rung::test::TestProgram;

class RealTimeTest : public testing::Test {
protected:
  RealTimeTest() {
    test.addPacked("R", 1, 8, 0);
    test.addChunk([](uint8_t* mem, rung_ctx*) { return ++mem[0], mem[1] == 0 ? RUNG_PC_DONE : RUNG_PC_FAULT; });
    test.addTask("MAIN", 0);
    test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 2000}, {RUNG_STEP_RUN, 0, 1}};
    test.link();
  }
  TestProgram test;
};

TEST_F(RealTimeTest, ClockOfTheProgramFollowsTheMachines) {
  Instance instance(test.program);
  const int64_t start = monotonicNs();
  int slices = 0;
  const RealTimeStats stats = runRealTime(instance, {}, [&] { return ++slices < 20; });
  const int64_t elapsed = monotonicNs() - start;
  EXPECT_EQ(stats.slices, 20u);
  EXPECT_EQ(instance.memory().readByte(0, 0), 20);
  EXPECT_GE(elapsed, 40'000'000);
  EXPECT_EQ(instance.nowUs(), 2000 * static_cast<int64_t>(20 + stats.missed));
  EXPECT_LE(instance.nowUs() * 1000, elapsed);
  EXPECT_FALSE(stats.priorityGranted);
  EXPECT_FALSE(stats.memoryLocked);
}

TEST_F(RealTimeTest, LatePeriodsAreCountedAndTheClockCatchesUp) {
  Instance instance(test.program);
  int slices = 0;
  const int64_t start = monotonicNs();
  const RealTimeStats stats = runRealTime(instance, {}, [&] {
    if (++slices == 2) std::this_thread::sleep_for(std::chrono::milliseconds(21));
    return slices < 4;
  });
  EXPECT_EQ(stats.slices, 4u);
  EXPECT_GE(stats.missed, 9u);
  EXPECT_GE(stats.maxLateNs, 18'000'000);
  EXPECT_GE(instance.nowUs(), 8000 + 18000);
  EXPECT_LE(instance.nowUs() * 1000, monotonicNs() - start);
}

// Bytes of this process that are locked in memory.
std::string lockedMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmLck:")) return line;
  return {};
}

// A lock that the host has taken for itself is still there afterwards.
TEST_F(RealTimeTest, MemoryStaysLocked) {
  if (mlockall(MCL_CURRENT) != 0) GTEST_SKIP() << "this system grants no locked memory";
  const std::string before = lockedMemory();
  Instance instance(test.program);
  const RealTimeStats stats = runRealTime(instance, {.lockMemory = true}, [] { return false; });
  EXPECT_TRUE(stats.memoryLocked);
  EXPECT_THAT(lockedMemory(), testing::Not(testing::HasSubstr(" 0 kB"))) << before;
  munlockall();
}

TEST_F(RealTimeTest, FaultEndsTheLoop) {
  Instance instance(test.program);
  EXPECT_EQ(instance.write(intRef(0, 1, 8), 1), std::nullopt);
  const RealTimeStats stats = runRealTime(instance, {}, [] { return true; });
  EXPECT_EQ(stats.slices, 1u);
  EXPECT_TRUE(instance.faulted());
}

} // namespace
