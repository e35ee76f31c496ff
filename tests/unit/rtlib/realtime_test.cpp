// The loop on the machine's clock, and what a thread asks of the system for it.
#include "rtlib/run/realtime.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/fake_clock.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using rung::test::TestProgram;

class RealTimeTest : public testing::Test {
protected:
  RealTimeTest() {
    test.addPacked("R", 1, 8, 0);
    test.addChunk(
        [](uint8_t* mem, rung_ctx*, uint32_t) { return ++mem[0], mem[1] == 0 ? RUNG_PC_DONE : RUNG_PC_FAULT; });
    test.addTask("MAIN", 0);
    test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 2000}, {RUNG_STEP_RUN, 0, 1}};
    test.link();
  }
  TestProgram test;
};

constexpr int64_t kMs = 1'000'000;

std::function<void()> slice(Instance& instance) {
  return [&instance] { instance.slice(); };
}

TEST_F(RealTimeTest, ClockOfTheProgramFollowsTheMachines) {
  Instance instance(test.program);
  FakeClock clock(1000 * kMs);
  int slices = 0;
  const RealTimeStats stats = runRealTime(instance, slice(instance), [&] { return ++slices < 20; });
  EXPECT_EQ(stats.slices, 20u);
  EXPECT_EQ(stats.missed, 0u);
  EXPECT_EQ(stats.maxLateNs, 0);
  EXPECT_EQ(stats.maxRunNs, 0);
  EXPECT_EQ(instance.memory().readByte(0, 0), 20);
  EXPECT_EQ(instance.nowUs(), 40'000);
  EXPECT_EQ(clock.ns(), 1040 * kMs);
  EXPECT_EQ(clock.sleeps(), 20);
}

TEST_F(RealTimeTest, AfterADelayThePassThatIsDueRuns) {
  Instance instance(test.program);
  FakeClock clock(1000 * kMs);
  int slices = 0;
  const RealTimeStats stats = runRealTime(instance, slice(instance), [&] {
    if (++slices == 2) clock.advance(21 * kMs);
    return slices < 13;
  });
  EXPECT_EQ(stats.slices, 13u);
  EXPECT_EQ(stats.missed, 9u); // due at 6 ms, run at 25 ms
  EXPECT_EQ(stats.maxLateNs, 19 * kMs);
  EXPECT_EQ(instance.nowUs(), 44'000);
  EXPECT_EQ(clock.ns(), 1044 * kMs);
}

TEST_F(RealTimeTest, PassesThatAreTooLateAreCountedAndTheClockIsRight) {
  Instance instance(test.program);
  FakeClock clock(1000 * kMs);
  int slices = 0;
  const RealTimeStats stats = runRealTime(instance, slice(instance), [&] {
    if (++slices == 2) clock.advance(101 * kMs);
    return slices < 14;
  });
  EXPECT_EQ(stats.missed, 49u); // due at 6 ms, run at 105 ms
  EXPECT_EQ(stats.maxLateNs, 99 * kMs);
  EXPECT_EQ(instance.nowUs(), 126'000);
  EXPECT_EQ(clock.ns(), 1126 * kMs);
}

// Whole scans only: what a scan has begun it ends.
TEST_F(RealTimeTest, NoPassIsLeftHalfDone) {
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 2000},
               {RUNG_STEP_RUN, 0, 1},
               {RUNG_STEP_ADVANCE, RUNG_NONE, 3000},
               {RUNG_STEP_RUN, 0, 1}};
  test.link();
  Instance instance(test.program);
  FakeClock clock;
  int slices = 0;
  const RealTimeStats stats = runRealTime(instance, slice(instance), [&] {
    if (++slices == 1) clock.advance(100 * kMs); // at 102 ms: the second slice is 97 ms late, the next scan 95 ms
    return slices < 2 + 2 * 11;
  });
  EXPECT_EQ(stats.missed, 19u);
  EXPECT_EQ(stats.maxLateNs, 97 * kMs);
  EXPECT_EQ(instance.nowUs(), 155'000);
}

// Lateness of less than a period misses nothing.
TEST_F(RealTimeTest, ALateWakeUpMissesNothing) {
  Instance instance(test.program);
  FakeClock clock;
  clock.setLateness(kMs);
  int slices = 0;
  const RealTimeStats stats = runRealTime(instance, slice(instance), [&] { return ++slices < 10; });
  EXPECT_EQ(stats.missed, 0u);
  EXPECT_EQ(stats.maxLateNs, kMs);
  EXPECT_EQ(instance.nowUs(), 20'000);
}

TEST_F(RealTimeTest, TheLongestSliceIsMeasured) {
  static FakeClock* running = nullptr;
  TestProgram slow;
  slow.addPacked("R", 1, 8, 0);
  slow.addChunk([](uint8_t* mem, rung_ctx*, uint32_t) {
    running->advance(++mem[0] == 3 ? 700'000 : 100'000);
    return RUNG_PC_DONE;
  });
  slow.addTask("MAIN", 0);
  slow.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 2000}, {RUNG_STEP_RUN, 0, 1}};
  slow.link();
  Instance instance(slow.program);
  FakeClock clock;
  running = &clock;
  int slices = 0;
  const RealTimeStats stats = runRealTime(instance, slice(instance), [&] { return ++slices < 5; });
  EXPECT_EQ(stats.maxRunNs, 700'000);
  EXPECT_EQ(stats.maxLateNs, 0);
}

// On the machine's own clock, which is only known not to stand still.
TEST_F(RealTimeTest, SleepsOnTheMachinesClock) {
  Instance instance(test.program);
  const int64_t start = monotonicNs();
  int slices = 0;
  const RealTimeStats stats = runRealTime(instance, slice(instance), [&] { return ++slices < 5; });
  EXPECT_GE(monotonicNs() - start, 10 * kMs);
  EXPECT_EQ(instance.nowUs(), 2000 * static_cast<int64_t>(5 + stats.missed));
}

// ---- the loop by itself ----

// A step each 10 ms, of which one takes longer.
class TenMs final : public Steps {
public:
  explicit TenMs(FakeClock& clock) : clock_(clock) {}
  int64_t dueAfter(int64_t dueNs, int64_t) noexcept override { return dueNs + 10 * kMs; }
  void prepare(int64_t untilNs) noexcept override {
    prepared.push_back(untilNs);
    clock_.advance(untilNs - clock_.ns());
  }
  void step(int64_t nowNs, int64_t elapsedNs) override {
    begun.push_back(nowNs);
    elapsed.push_back(elapsedNs);
    if (begun.size() == 2) clock_.advance(13 * kMs);
  }
  void stepped(const Step& step) override { done.push_back(step); }
  bool ended() override { return begun.size() == 4; }

  std::vector<int64_t> prepared, begun, elapsed;
  std::vector<Step> done;

private:
  FakeClock& clock_;
};

TEST(StepsTest, BeginWhenTheyAreDueAndAreTimed) {
  FakeClock clock(1000 * kMs);
  TenMs steps(clock);
  runSteps(steps);
  EXPECT_THAT(steps.begun, testing::ElementsAre(1010 * kMs, 1020 * kMs, 1033 * kMs, 1040 * kMs));
  EXPECT_THAT(steps.elapsed, testing::ElementsAre(10 * kMs, 10 * kMs, 13 * kMs, 7 * kMs));
  EXPECT_TRUE(steps.prepared.empty());
  ASSERT_EQ(steps.done.size(), 4u);
  EXPECT_EQ(steps.done[1].tookNs, 13 * kMs);
  EXPECT_EQ(steps.done[2].beginNs, 33 * kMs);
  EXPECT_EQ(steps.done[2].periodNs, 13 * kMs);
  EXPECT_EQ(steps.done[2].lateNs, 3 * kMs);
}

TEST(StepsTest, ArePreparedByAThreadThatIsAwakeEarly) {
  FakeClock clock(1000 * kMs);
  TenMs steps(clock);
  runSteps(steps, kMs);
  EXPECT_THAT(steps.prepared, testing::ElementsAre(1010 * kMs, 1020 * kMs, 1030 * kMs, 1040 * kMs));
  EXPECT_EQ(steps.begun[0], 1010 * kMs);
  EXPECT_EQ(clock.sleeps(), 4);
}

// ---- what is asked of the system ----

int policy() { return sched_getscheduler(0); }

TEST(RealTimeThread, AsksForNothingByItself) {
  const int before = policy();
  const RealTimeThread thread({});
  EXPECT_EQ(thread.problem(), "");
  EXPECT_EQ(policy(), before);
}

TEST(RealTimeThread, HasItsPriorityAndPutsItBack) {
  const int before = policy();
  {
    const RealTimeThread thread({.priority = 10});
    if (!thread.problem().empty()) GTEST_SKIP() << thread.problem();
    EXPECT_EQ(policy(), SCHED_FIFO);
    sched_param param{};
    sched_getparam(0, &param);
    EXPECT_EQ(param.sched_priority, 10);
  }
  EXPECT_EQ(policy(), before);
}

// Bytes of this process that are locked in memory.
std::string lockedMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmLck:")) return line;
  return {};
}

// A sanitizer's mlockall says yes and does nothing. Nothing is locked afterwards.
bool locksArePretended() {
  const bool pretended = mlockall(MCL_CURRENT) == 0 && lockedMemory().find(" 0 kB") != std::string::npos;
  munlockall();
  return pretended;
}

TEST(RealTimeThread, SaysWhatIsNotGranted) {
  const auto refused = [](const RealTimeOptions& options) {
    const rlimit none = {0, 0};
    setrlimit(RLIMIT_RTPRIO, &none);
    setrlimit(RLIMIT_MEMLOCK, &none);
    if (geteuid() == 0 && setresuid(65534, 65534, 65534) != 0) std::exit(1);
    const RealTimeThread thread(options);
    std::fprintf(stderr, "%s", thread.problem().c_str());
    std::exit(policy() == SCHED_OTHER ? 0 : 1);
  };
  EXPECT_EXIT(refused({.priority = 10}), testing::ExitedWithCode(0), "^real-time priority 10: .*ulimit -r");
  if (!locksArePretended()) {
    EXPECT_EXIT(refused({.lockMemory = true}), testing::ExitedWithCode(0), "^memory cannot be locked: .*ulimit -l");
  }
  EXPECT_EXIT(refused({.priority = 100}), testing::ExitedWithCode(0), "^real-time priority 100: ");
}

// A lock is the process's.
TEST(RealTimeThread, MemoryStaysLocked) {
  if (locksArePretended()) GTEST_SKIP() << "a sanitizer does nothing for mlockall";
  {
    const RealTimeThread thread({.lockMemory = true});
    if (!thread.problem().empty()) GTEST_SKIP() << thread.problem();
  }
  EXPECT_THAT(lockedMemory(), testing::Not(testing::HasSubstr(" 0 kB")));
  munlockall();
}

TEST_F(RealTimeTest, FaultEndsTheLoop) {
  Instance instance(test.program);
  EXPECT_EQ(instance.write(intRef(0, 1, 8), 1), std::nullopt);
  const RealTimeStats stats = runRealTime(instance, slice(instance), [] { return true; });
  EXPECT_EQ(stats.slices, 1u);
  EXPECT_TRUE(instance.faulted());
}

} // namespace
