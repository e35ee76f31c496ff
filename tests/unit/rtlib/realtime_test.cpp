// The loop on the machine's clock. Bounds are loose: the machine may be busy.
#include "rtlib/host/realtime.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

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

bool nothingLocked() { return lockedMemory().find(" 0 kB") != std::string::npos; }

// False also where a sanitizer makes locking do nothing. Nothing is locked afterwards.
bool grantsLocks() {
  const bool granted = mlockall(MCL_CURRENT) == 0 && !nothingLocked();
  munlockall();
  return granted;
}

// A lock that the host has taken for itself is still there afterwards.
TEST_F(RealTimeTest, MemoryStaysLocked) {
  if (!grantsLocks()) GTEST_SKIP() << "this system grants no locked memory";
  ASSERT_EQ(mlockall(MCL_CURRENT), 0);
  Instance instance(test.program);
  const RealTimeStats stats = runRealTime(instance, {.lockMemory = true}, [] { return false; });
  EXPECT_TRUE(stats.memoryLocked);
  EXPECT_FALSE(nothingLocked());
  munlockall();
}

// In a process of its own, which may give up rights: what `check` answers, or an empty text when it could not run.
template <class Check>
std::string inAProcess(Check check) {
  int ends[2];
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    const std::string answer = check();
    _exit(write(ends[1], answer.data(), answer.size()) == static_cast<ssize_t>(answer.size()) ? 0 : 1);
  }
  close(ends[1]);
  std::string answer(1000, '\0');
  const ssize_t size = read(ends[0], answer.data(), answer.size());
  close(ends[0]);
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  answer.resize(size > 0 ? static_cast<size_t>(size) : 0);
  return answer;
}

std::string scheduling() {
  int policy = 0;
  sched_param param{};
  if (pthread_getschedparam(pthread_self(), &policy, &param) != 0) return "unknown";
  return (policy == SCHED_FIFO ? "FIFO " : "other ") + std::to_string(param.sched_priority);
}

// Nobody; what root may do is gone.
bool becomeNobody() { return geteuid() != 0 || (setgid(65534) == 0 && setuid(65534) == 0); }

TEST_F(RealTimeTest, PriorityHoldsWhileTheLoopRunsAndNoLonger) {
  const std::string answer = inAProcess([&]() -> std::string {
    sched_param param{};
    param.sched_priority = 1;
    if (pthread_setschedparam(pthread_self(), SCHED_FIFO, &param) != 0) return "refused";
    param.sched_priority = 0;
    pthread_setschedparam(pthread_self(), SCHED_OTHER, &param);
    Instance instance(test.program);
    std::string during;
    const RealTimeStats stats = runRealTime(instance, {.priority = 7}, [&] {
      during = scheduling();
      return false;
    });
    return during + (stats.priorityGranted ? ", granted, " : ", not granted, ") + scheduling();
  });
  if (answer == "refused") GTEST_SKIP() << "this system grants no real-time priority";
  EXPECT_EQ(answer, "FIFO 7, granted, other 0");
}

// The loop runs all the same.
TEST_F(RealTimeTest, PriorityThatIsRefusedIsReported) {
  const std::string answer = inAProcess([&]() -> std::string {
    const rlimit none{};
    if (setrlimit(RLIMIT_RTPRIO, &none) != 0 || !becomeNobody()) return "cannot give up rights";
    Instance instance(test.program);
    std::string during;
    const RealTimeStats stats = runRealTime(instance, {.priority = 7}, [&] {
      during = scheduling();
      return instance.memory().readByte(0, 0) < 3;
    });
    return during + (stats.priorityGranted ? ", granted, " : ", not granted, ") + std::to_string(stats.slices);
  });
  EXPECT_EQ(answer, "other 0, not granted, 3");
}

TEST_F(RealTimeTest, TheLoopLocksMemoryAndLeavesItLocked) {
  const std::string answer = inAProcess([&]() -> std::string {
    if (!grantsLocks()) return "refused";
    const std::string before = nothingLocked() ? "none, " : "some, ";
    Instance instance(test.program);
    std::string during;
    const RealTimeStats stats = runRealTime(instance, {.lockMemory = true}, [&] {
      during = nothingLocked() ? "none, " : "some, ";
      return false;
    });
    return before + during + (nothingLocked() ? "none, " : "some, ") + (stats.memoryLocked ? "locked" : "not locked");
  });
  if (answer == "refused") GTEST_SKIP() << "this system grants no locked memory";
  EXPECT_EQ(answer, "none, some, some, locked");
}

TEST_F(RealTimeTest, ALockThatIsRefusedIsReported) {
  const std::string answer = inAProcess([&]() -> std::string {
    const rlimit none{};
    if (setrlimit(RLIMIT_MEMLOCK, &none) != 0 || !becomeNobody()) return "cannot give up rights";
    if (mlockall(MCL_CURRENT) == 0) return "granted"; // by a sanitizer, which does nothing
    Instance instance(test.program);
    const RealTimeStats stats =
        runRealTime(instance, {.lockMemory = true}, [&] { return instance.memory().readByte(0, 0) < 3; });
    return (stats.memoryLocked ? "locked, " : "not locked, ") + std::to_string(stats.slices);
  });
  if (answer == "granted") GTEST_SKIP() << "nothing refuses a lock here";
  EXPECT_EQ(answer, "not locked, 3");
}

TEST_F(RealTimeTest, FaultEndsTheLoop) {
  Instance instance(test.program);
  EXPECT_EQ(instance.write(intRef(0, 1, 8), 1), std::nullopt);
  const RealTimeStats stats = runRealTime(instance, {}, [] { return true; });
  EXPECT_EQ(stats.slices, 1u);
  EXPECT_TRUE(instance.faulted());
}

} // namespace
