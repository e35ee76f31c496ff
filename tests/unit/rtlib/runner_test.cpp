// The chunk loop: calls, parts, budget, border copies, faults; and the walk over the schedule.
#include "rtlib/core/runner.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cfenv>
#include <thread>
#include <utility>
#include <vector>

#include "rtlib/core/float_environment.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::core;
using rung::test::callChunk;
using rung::test::popChunk;
using rung::test::TestProgram;

// Chunks write their number into a trace at the end of the memory: mem[200] is its length.
void trace(uint8_t* mem, uint8_t number) { mem[201 + mem[200]++] = number; }

class RunnerTest : public testing::Test {
protected:
  Runner& start() {
    parts.resize(test.tasks.size());
    memory.assign(test.memorySize, 0);
    room.resize(test.scan.size());
    runner = std::make_unique<Runner>(test.link(), memory.data(), context, parts.data(), nullptr, room.data());
    return *runner;
  }
  std::vector<int> takeTrace() {
    std::vector<int> numbers(memory.begin() + 201, memory.begin() + 201 + memory[200]);
    memory[200] = 0;
    return numbers;
  }
  using Trace = std::vector<int>;

  TestProgram test;
  rung_ctx context{};
  std::vector<PartState> parts;
  std::vector<rung_step> room;
  std::vector<uint8_t> memory;
  std::unique_ptr<Runner> runner;
};

template <uint8_t N, uint32_t Next>
uint32_t step(uint8_t* mem, rung_ctx*, uint32_t) {
  trace(mem, N);
  return Next;
}

// A clock that shows a microsecond more each time.
int64_t tickingNs() {
  static int64_t now = 0;
  return now += 1000;
}

// A chunk that stays within its budget of steps can still take too long.
TEST_F(RunnerTest, ATimeLimitStopsBetweenChunks) {
  for (uint32_t i = 0; i < 20; ++i)
    test.addChunk([](uint8_t* mem, rung_ctx*, uint32_t) { return ++mem[0] == 20 ? RUNG_PC_DONE : uint32_t{mem[0]}; });
  test.addTask("MAIN", 0);
  Runner& r = start();
  EXPECT_TRUE(r.runTask(0)); // without a limit
  memory[0] = 0;
  r.setTimeLimit({.ns = 30'000, .nowNs = &tickingNs});
  EXPECT_TRUE(r.runTask(0));
  memory[0] = 0;
  r.setTimeLimit({.ns = 10'000, .nowNs = &tickingNs});
  EXPECT_FALSE(r.runTask(0));
  EXPECT_TRUE(r.faulted());
  EXPECT_EQ(r.fault().code, kMaxTimeFault) << "it is not the budget that is used up";
  EXPECT_LT(memory[0], 15);
  r.reset();
  memory[0] = 15; // each run has its own time
  EXPECT_TRUE(r.runTask(0));
}

// A host may calculate otherwise; programs do not, and the host has its settings back.
TEST_F(RunnerTest, FloatingPointAsProgramsAreCompiledFor) {
  test.addChunk([](uint8_t* mem, rung_ctx*, uint32_t) {
    const volatile double one = 1;
    const volatile double tiny = 1e-300;
    mem[0] = one + tiny == 1 ? 1 : 2;         // rounded to nearest
    mem[1] = tiny * 1e-15 != 0 ? 1 : 2;       // a subnormal number is not 0
    mem[2] = one / (tiny - tiny) > 1 ? 1 : 2; // no trap
    return mem[3] == 0 ? RUNG_PC_DONE : RUNG_PC_FAULT;
  });
  test.addTask("MAIN", 0);
  Runner& r = start();
  const uint32_t before = floatControl();
  ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
#if defined(__x86_64__)
  setFloatControl((floatControl() | 0x8040) & ~0x200u); // subnormals are 0, a division by 0 traps
#endif
  const uint32_t own = floatControl() & ~kFloatStatus;
  EXPECT_TRUE(r.runTask(0));
  const uint32_t after = floatControl() & ~kFloatStatus;
  const std::vector<uint8_t> seen(memory.begin(), memory.begin() + 3);
  memory[3] = 1;
  EXPECT_FALSE(r.runTask(0));
  const uint32_t afterFault = floatControl() & ~kFloatStatus;
  setFloatControl(before);
  EXPECT_EQ(seen, (std::vector<uint8_t>{1, 1, 1}));
  EXPECT_EQ(after, own);
  EXPECT_EQ(afterFault, own);
}

TEST_F(RunnerTest, RunsCallsAndReturns) {
  // 0 calls 3, 3 calls 2, both return; 1 ends the run.
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) { return trace(mem, 0), callChunk(ctx, 3, 1); });
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) { return trace(mem, 1), popChunk(ctx); });
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) { return trace(mem, 2), popChunk(ctx); });
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) { return trace(mem, 3), callChunk(ctx, 2, 4); });
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) { return trace(mem, 4), popChunk(ctx); });
  const uint32_t task = test.addTask("MAIN", 0);
  EXPECT_TRUE(start().runTask(task));
  EXPECT_EQ(takeTrace(), (Trace{0, 3, 2, 4, 1}));
  EXPECT_TRUE(runner->runTask(task)); // the stack starts anew
  EXPECT_EQ(takeTrace(), (Trace{0, 3, 2, 4, 1}));
}

TEST_F(RunnerTest, RunsChunksOfAnInterpreter) {
  const auto interpret = [](uint8_t* mem, rung_ctx*, uint32_t chunk) {
    trace(mem, static_cast<uint8_t>(chunk));
    return chunk == 0 ? 1u : RUNG_PC_DONE;
  };
  test.addChunk(interpret);
  test.addChunk(interpret);
  const uint32_t task = test.addTask("MAIN", 0);
  EXPECT_TRUE(start().runTask(task));
  EXPECT_EQ(takeTrace(), (Trace{0, 1}));
}

// Another thread enters other code for a chunk while chunks run.
TEST_F(RunnerTest, RunsChunksWhoseCodeIsExchanged) {
  constexpr rung_chunk_fn kOne = [](uint8_t* mem, rung_ctx* ctx, uint32_t) { return ++mem[0], popChunk(ctx); };
  constexpr rung_chunk_fn kOther = [](uint8_t* mem, rung_ctx* ctx, uint32_t) { return mem[0] += 1, popChunk(ctx); };
  test.addTask("MAIN", test.addChunk(kOne));
  Runner& running = start();
  std::atomic<bool> end{false};
  std::thread exchanging([&] {
    for (uint32_t i = 0; !end; ++i)
      std::atomic_ref(test.functions[0]).store(i % 2 == 0 ? kOne : kOther, std::memory_order_release);
  });
  for (int i = 0; i < 10'000; ++i) ASSERT_TRUE(running.runTask(0));
  end = true;
  exchanging.join();
  EXPECT_EQ(memory[0], 10'000 % 256);
}

TEST_F(RunnerTest, BudgetStopsAnEndlessLoopAndNamesItsRung) {
  test.addChunk(step<0, 1>);
  test.addChunk([](uint8_t* mem, rung_ctx*, uint32_t) { return ++mem[0], 1u; }, 10);
  test.safeSpans = {{16, 4}};
  const uint32_t task = test.addTask("MAIN", 0, 100);
  start();
  memory[15] = memory[16] = memory[19] = memory[20] = 1;
  EXPECT_FALSE(runner->runTask(task));
  EXPECT_EQ(memory[0], 9); // 1 + 9 * 10 <= 100
  EXPECT_TRUE(runner->faulted());
  EXPECT_EQ(runner->fault().code, 0u);
  EXPECT_EQ(runner->fault().rung, 1u);
  EXPECT_EQ(runner->fault().line, 0u);
  EXPECT_EQ(runner->fault().task, task);
  EXPECT_EQ(memory[16] + memory[19], 0);
  EXPECT_EQ(memory[15] + memory[20], 2);
  EXPECT_FALSE(runner->runTask(task)); // stopped
  EXPECT_EQ(memory[0], 9);
  runner->reset();
  EXPECT_FALSE(runner->faulted());
  EXPECT_FALSE(runner->runTask(task));
  EXPECT_EQ(memory[0], 18);
}

TEST_F(RunnerTest, BudgetThatIsExactlyUsedUpIsEnough) {
  test.addChunk(step<0, 1>, 3);
  test.addChunk(step<1, RUNG_PC_DONE>, 4);
  const uint32_t enough = test.addTask("A", 0, 7);
  const uint32_t less = test.addTask("B", 0, 6);
  EXPECT_TRUE(start().runTask(enough));
  EXPECT_FALSE(runner->runTask(less));
}

TEST_F(RunnerTest, ExtraWeightIsTakenOffTheBudget) {
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) { return trace(mem, 0), ctx->extra_weight = 5, 1u; }, 3);
  test.addChunk(step<1, RUNG_PC_DONE>, 4);
  const uint32_t enough = test.addTask("A", 0, 12);
  const uint32_t less = test.addTask("B", 0, 11);
  const uint32_t least = test.addTask("C", 0, 7);
  EXPECT_TRUE(start().runTask(enough));
  EXPECT_EQ(takeTrace(), (Trace{0, 1}));
  EXPECT_FALSE(runner->runTask(less));
  EXPECT_EQ(takeTrace(), (Trace{0}));
  EXPECT_EQ(runner->fault().rung, 1u);
  runner->reset();
  EXPECT_FALSE(runner->runTask(least));
  EXPECT_EQ(runner->fault().rung, 0u);
}

// The tables are wrong here, so that it shows.
TEST_F(RunnerTest, WhatCannotUseUpItsBudgetIsNotCounted) {
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) { return trace(mem, 0), ctx->extra_weight = 50, 1u; }, 3);
  test.addChunk(step<1, RUNG_PC_DONE>, 4);
  const uint32_t bounded = test.addTask("A", 0, 5);
  test.tasks[bounded].longest = 4;
  const uint32_t counted = test.addTask("B", 1, 5);
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 10}, {RUNG_STEP_RUN, bounded, 3}};
  start();
  runner->scan();
  EXPECT_EQ(takeTrace(), (Trace{0, 1, 0, 1, 0, 1}));
  EXPECT_TRUE(runner->runTask(counted)) << "what the other one has left there is not its own";
  runner->setStopped(true);
  takeTrace();
  EXPECT_TRUE(runner->runTask(bounded)); // by hand
  EXPECT_EQ(takeTrace(), (Trace{0, 1}));
  runner->scan();
  EXPECT_EQ(takeTrace(), Trace{});
}

// What it may change is mem[1], which counts up to mem[9].
uint32_t countUp(uint8_t* mem, rung_ctx*, uint32_t) {
  trace(mem, 0);
  if (mem[1] < mem[9]) ++mem[1];
  return RUNG_PC_DONE;
}

TEST_F(RunnerTest, ARowEndsOnceARunHasChangedNothing) {
  test.addChunk(countUp);
  const uint32_t task = test.addTask("FAST", 0);
  test.tasks[task].longest = 1;
  test.addChanges(task, {1});
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 10}, {RUNG_STEP_RUN, task, 20}};
  start();
  runner->scan();
  EXPECT_EQ(takeTrace().size(), 2u);
  memory[9] = 1; // the first run finds something new
  runner->scan();
  EXPECT_EQ(takeTrace().size(), 2u);
  EXPECT_EQ(memory[1], 1);
  memory[9] = 18; // the second run changes something, too
  runner->scan();
  EXPECT_EQ(takeTrace().size(), 20u);
  EXPECT_EQ(memory[1], 18);
  test.tasks[task].change_count = 0; // no promise
  start();
  runner->scan();
  EXPECT_EQ(takeTrace().size(), 20u);
}

// mem[1] rounds of chunk 0, then 1 and 2; each weighs 3. The tables call 1 and 2 lighter, so that it shows.
TEST_F(RunnerTest, WhatComesAfterTheLastLoopIsNotCounted) {
  test.addChunk([](uint8_t* mem, rung_ctx*, uint32_t) { return trace(mem, 0), mem[1]-- == 0 ? 1u : 0u; }, 3);
  test.addChunk(step<1, 2>, 3);
  test.addChunk(step<2, RUNG_PC_DONE>, 3);
  const uint32_t task = test.addTask("MAIN", 0, 10);
  test.tasks[task].loops = 1;
  test.tasks[task].loop_free_chunk = 1;
  test.tasks[task].loop_free_weight = 4;
  start();
  memory[1] = 1;
  EXPECT_TRUE(runner->runTask(task)) << "4 are left";
  EXPECT_EQ(takeTrace(), (Trace{0, 0, 1, 2}));
  memory[1] = 2;
  EXPECT_FALSE(runner->runTask(task)) << "1 is left";
  EXPECT_EQ(takeTrace(), (Trace{0, 0, 0}));
  runner->reset();
  memory[1] = 9;
  EXPECT_FALSE(runner->runTask(task)) << "it loops too long";
  EXPECT_EQ(takeTrace(), (Trace{0, 0, 0}));
}

TEST_F(RunnerTest, AFaultEndsWhatIsNotCounted) {
  test.addChunk([](uint8_t* mem, rung_ctx*, uint32_t) { return trace(mem, 0), uint32_t{RUNG_PC_FAULT}; });
  const uint32_t task = test.addTask("A", 0);
  test.tasks[task].longest = 1;
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 10}, {RUNG_STEP_RUN, task, 3}};
  start();
  runner->scan();
  EXPECT_EQ(takeTrace(), Trace{0});
  EXPECT_TRUE(runner->faulted());
  EXPECT_EQ(runner->fault().task, task);
}

TEST_F(RunnerTest, FaultOfAChunkIsKept) {
  test.addChunk([](uint8_t*, rung_ctx* ctx, uint32_t) {
    ctx->fault = {1, 0, 12, RUNG_NONE};
    return RUNG_PC_FAULT;
  });
  const uint32_t task = test.addTask("MAIN", 0);
  EXPECT_FALSE(start().runTask(task));
  EXPECT_EQ(runner->fault().code, 1u);
  EXPECT_EQ(runner->fault().line, 12u);
  EXPECT_EQ(runner->fault().task, task);
}

TEST_F(RunnerTest, ChunkThatDoesNotExistIsAFault) {
  test.addChunk(step<0, 55>);
  EXPECT_FALSE(start().runTask(test.addTask("LATE", 0))); // added behind start: no such task
  EXPECT_FALSE(runner->faulted());
  test.addTask("MAIN", 0);
  EXPECT_FALSE(start().runTask(0));
  EXPECT_EQ(runner->fault().code, kUndescribedFault);
}

TEST_F(RunnerTest, CopiesAtTheBorders) {
  test.addChunk([](uint8_t* mem, rung_ctx*, uint32_t) {
    mem[8] = static_cast<uint8_t>(mem[4] + 1); // from the latch
    mem[16] = 0x0F;                            // a masked store of the low half
    mem[20] = 0x0F;
    return RUNG_PC_DONE;
  });
  const uint32_t task = test.addTask("MAIN", 0);
  test.addBeginCopy(task, {RUNG_COPY_ALL, 0, 4, 0, 2});
  test.addEndCopy(task, {RUNG_COPY_ALL, 8, 12, 0, 1});
  test.addEndCopy(task, {RUNG_COPY_MASKED, 16, 24, 20, 2});
  start();
  memory[0] = 41;
  memory[1] = 7;
  memory[24] = 0xA5;
  memory[25] = 0x5A;
  EXPECT_TRUE(runner->runTask(task));
  EXPECT_EQ(memory[4], 41);
  EXPECT_EQ(memory[5], 7);
  EXPECT_EQ(memory[12], 42);
  EXPECT_EQ(memory[24], 0xAF);
  EXPECT_EQ(memory[25], 0x5A); // mask 0: untouched
  EXPECT_EQ(memory[20], 0);    // the mask is used up
}

TEST_F(RunnerTest, FaultLeavesTheEndCopiesOut) {
  test.addChunk([](uint8_t* mem, rung_ctx*, uint32_t) { return mem[8] = 1, RUNG_PC_FAULT; });
  const uint32_t task = test.addTask("MAIN", 0);
  test.addEndCopy(task, {RUNG_COPY_ALL, 8, 12, 0, 1});
  EXPECT_FALSE(start().runTask(task));
  EXPECT_EQ(memory[8], 1);
  EXPECT_EQ(memory[12], 0);
  EXPECT_EQ(runner->fault().code, kUndescribedFault);
}

TEST_F(RunnerTest, PartsRunOneAStepWithBeginOnceAndEndAlways) {
  test.addChunk(step<0, 1>);
  test.addChunk(step<1, 2>);
  test.addChunk(step<2, RUNG_PC_DONE>);
  const uint32_t task = test.addTask("L2", 0, 1000, {1, 2, RUNG_PC_DONE});
  test.addBeginCopy(task, {RUNG_COPY_ALL, 0, 4, 0, 1});
  test.addEndCopy(task, {RUNG_COPY_ALL, 200, 8, 0, 1});
  start();
  for (int run = 0; run < 2; ++run) {
    memory[0] = static_cast<uint8_t>(run + 1);
    for (int part = 0; part < 3; ++part) {
      EXPECT_TRUE(runner->runPart(task));
      EXPECT_EQ(memory[4], run + 1);
      EXPECT_EQ(memory[8], 1) << "end copies after part " << part;
      EXPECT_EQ(takeTrace(), Trace{part});
      memory[0] = 99; // seen by the next run only
    }
  }
}

TEST_F(RunnerTest, PartNeverEndsInsideASubroutine) {
  // The subroutine's chunk 3 lies behind the border 1, and is run inside part 0.
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) { return trace(mem, 0), callChunk(ctx, 3, 1); });
  test.addChunk(step<1, 2>);
  test.addChunk(step<2, RUNG_PC_DONE>);
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) { return trace(mem, 3), popChunk(ctx); });
  const uint32_t task = test.addTask("L2", 0, 1000, {1, RUNG_PC_DONE});
  start().runPart(task);
  EXPECT_EQ(takeTrace(), (Trace{0, 3}));
  runner->runPart(task);
  EXPECT_EQ(takeTrace(), (Trace{1, 2}));
}

TEST_F(RunnerTest, JumpOverABorderSuspendsAtItsTarget) {
  // 0 jumps to 2, over the borders 1 and 2: the next step goes on there, the third idles.
  test.addChunk(step<0, 2>);
  test.addChunk(step<1, 2>);
  test.addChunk(step<2, RUNG_PC_DONE>);
  const uint32_t task = test.addTask("L2", 0, 1000, {1, 2, RUNG_PC_DONE});
  start().runPart(task);
  EXPECT_EQ(takeTrace(), Trace{0});
  runner->runPart(task);
  EXPECT_EQ(takeTrace(), Trace{2});
  runner->runPart(task);
  EXPECT_EQ(takeTrace(), Trace{});
  runner->runPart(task);
  EXPECT_EQ(takeTrace(), Trace{0});
}

TEST_F(RunnerTest, RunThatEndsEarlyIdlesThroughItsParts) {
  test.addChunk(step<0, RUNG_PC_DONE>);
  test.addChunk(step<1, RUNG_PC_DONE>);
  const uint32_t task = test.addTask("L2", 0, 1000, {1, RUNG_PC_DONE});
  start().runPart(task);
  EXPECT_EQ(takeTrace(), Trace{0});
  runner->runPart(task);
  EXPECT_EQ(takeTrace(), Trace{});
  runner->runPart(task);
  EXPECT_EQ(takeTrace(), Trace{0});
}

TEST_F(RunnerTest, BackwardJumpOverABorderStaysInItsPart) {
  // 1 jumps back to 0 once: the rest of the part runs on to its own border.
  test.addChunk(step<0, 1>);
  test.addChunk([](uint8_t* mem, rung_ctx*, uint32_t) { return trace(mem, 1), mem[0]++ == 0 ? 0u : 2u; });
  test.addChunk(step<2, RUNG_PC_DONE>);
  const uint32_t task = test.addTask("L2", 0, 1000, {1, 2, RUNG_PC_DONE});
  start().runPart(task);
  runner->runPart(task);
  EXPECT_EQ(takeTrace(), (Trace{0, 1, 0, 1}));
  runner->runPart(task);
  EXPECT_EQ(takeTrace(), Trace{2});
}

TEST_F(RunnerTest, BudgetIsOneRunsOverAllItsParts) {
  test.addChunk(step<0, 1>, 6);
  test.addChunk(step<1, RUNG_PC_DONE>, 6);
  const uint32_t task = test.addTask("L2", 0, 11, {1, RUNG_PC_DONE});
  EXPECT_TRUE(start().runPart(task));
  EXPECT_FALSE(runner->runPart(task));
  EXPECT_EQ(runner->fault().rung, 1u);
}

TEST_F(RunnerTest, AnotherTaskRunsBetweenParts) {
  test.addChunk(step<0, 1>);
  test.addChunk(step<1, RUNG_PC_DONE>);
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) { return trace(mem, 2), callChunk(ctx, 3, 4); });
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) { return trace(mem, 3), popChunk(ctx); });
  test.addChunk(step<4, RUNG_PC_DONE>);
  const uint32_t slow = test.addTask("L2", 0, 1000, {1, RUNG_PC_DONE});
  const uint32_t fast = test.addTask("L1", 2);
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000},
               {RUNG_STEP_RUN, fast, 1},
               {RUNG_STEP_PART, slow, 0},
               {RUNG_STEP_SLOT, RUNG_NONE, 0},
               {RUNG_STEP_ADVANCE, RUNG_NONE, 8000},
               {RUNG_STEP_RUN, fast, 1},
               {RUNG_STEP_PART, slow, 0},
               {RUNG_STEP_SLOT, RUNG_NONE, 0}};
  test.fast = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_RUN, fast, 1}};
  start().scan();
  EXPECT_EQ(takeTrace(), (Trace{2, 3, 4, 0, 2, 3, 4, 1}));
  EXPECT_EQ(runner->nowUs(), 16000);
  runner->slot();
  EXPECT_EQ(takeTrace(), (Trace{2, 3, 4, 0}));
  EXPECT_FALSE(runner->atListStart());
  runner->fast(); // the scan list stays where it is
  EXPECT_EQ(takeTrace(), (Trace{2, 3, 4}));
  runner->scan(); // the rest of the cycle
  EXPECT_EQ(takeTrace(), (Trace{2, 3, 4, 1}));
  EXPECT_TRUE(runner->atListStart());
  EXPECT_EQ(runner->nowUs(), 40000);
}

TEST_F(RunnerTest, ResetForgetsTheRunUnderWayAndThePlaceInTheSchedule) {
  test.addChunk(step<0, 1>);
  test.addChunk(step<1, RUNG_PC_DONE>);
  const uint32_t task = test.addTask("L2", 0, 1000, {1, RUNG_PC_DONE});
  test.scan = {{RUNG_STEP_PART, task, 0}, {RUNG_STEP_SLOT, RUNG_NONE, 0}, {RUNG_STEP_PART, task, 0}};
  start().slot();
  EXPECT_FALSE(runner->atListStart());
  runner->setStopped(true);
  runner->reset();
  EXPECT_TRUE(runner->atListStart());
  EXPECT_FALSE(runner->stopped());
  runner->scan();
  EXPECT_EQ(takeTrace(), (Trace{0, 0, 1}));
}

TEST_F(RunnerTest, SlotsOfASlotlessListAreScans) {
  test.addChunk(step<0, RUNG_PC_DONE>);
  test.scan = {{RUNG_STEP_RUN, test.addTask("MAIN", 0), 3}};
  start().slot();
  EXPECT_EQ(takeTrace(), (Trace{0, 0, 0}));
  EXPECT_EQ(runner->nowUs(), 8000); // a list without ADVANCE takes the main task's period
  EXPECT_EQ(runner->sliceDelayUs(), 8000u);
  runner->slice();
  EXPECT_EQ(takeTrace(), (Trace{0, 0, 0}));
  EXPECT_EQ(runner->nowUs(), 16000);
}

// A program may have another order for a real clock, which takes the same time. Scans keep theirs.
TEST_F(RunnerTest, SlicesOfTheirOwnList) {
  test.addChunk(step<0, RUNG_PC_DONE>);
  test.addChunk(step<1, RUNG_PC_DONE>);
  const uint32_t fast = test.addTask("FAST", 0);
  const uint32_t main = test.addTask("MAIN", 1);
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 2000}, {RUNG_STEP_RUN, fast, 2}, {RUNG_STEP_RUN, main, 1}};
  test.slices = {{RUNG_STEP_ADVANCE, RUNG_NONE, 1000},
                 {RUNG_STEP_RUN, fast, 1},
                 {RUNG_STEP_RUN, main, 1},
                 {RUNG_STEP_ADVANCE, RUNG_NONE, 1000},
                 {RUNG_STEP_RUN, fast, 1}};
  EXPECT_EQ(start().sliceDelayUs(), 1000u);
  runner->slice();
  EXPECT_EQ(takeTrace(), (Trace{0, 1}));
  EXPECT_FALSE(runner->atListStart());
  EXPECT_EQ(runner->sliceDelayUs(), 1000u);
  runner->slice();
  EXPECT_EQ(takeTrace(), Trace{0});
  EXPECT_TRUE(runner->atListStart());
  EXPECT_EQ(runner->nowUs(), 2000);
  runner->scan();
  EXPECT_EQ(takeTrace(), (Trace{0, 0, 1}));
  EXPECT_EQ(runner->nowUs(), 4000);
  runner->slice();
  runner->scan(); // what is left of the scan
  EXPECT_EQ(takeTrace(), (Trace{0, 1, 0}));
  EXPECT_TRUE(runner->atListStart());
  EXPECT_EQ(runner->nowUs(), 6000);
}

TEST_F(RunnerTest, SlicesEndBeforeTheClockMovesOn) {
  test.addChunk(step<0, RUNG_PC_DONE>);
  test.addChunk(step<1, RUNG_PC_DONE>);
  const uint32_t a = test.addTask("INT0", 0);
  const uint32_t b = test.addTask("MAIN", 1);
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 2000},
               {RUNG_STEP_RUN, a, 1},
               {RUNG_STEP_ADVANCE, RUNG_NONE, 3000},
               {RUNG_STEP_RUN, a, 1},
               {RUNG_STEP_RUN, b, 1}};
  EXPECT_EQ(start().sliceDelayUs(), 2000u);
  runner->slice();
  EXPECT_EQ(takeTrace(), Trace{0});
  EXPECT_EQ(runner->nowUs(), 2000);
  EXPECT_EQ(runner->sliceDelayUs(), 3000u);
  runner->slice();
  EXPECT_EQ(takeTrace(), (Trace{0, 1}));
  EXPECT_EQ(runner->nowUs(), 5000);
  EXPECT_TRUE(runner->atListStart());
}

TEST_F(RunnerTest, HooksRunTasksOutsideTasksOnly) {
  test.addChunk(step<0, RUNG_PC_DONE>);
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) { // misbehaves: a task that starts a task
    trace(mem, 1);
    EXPECT_FALSE(static_cast<Runner*>(ctx->host_data)->runTask(0));
    return RUNG_PC_DONE;
  });
  test.addTask("A", 0);
  const uint32_t b = test.addTask("B", 1);
  test.scan = {{RUNG_STEP_HOOK, RUNG_NONE, 7}, {RUNG_STEP_RUN, b, 1}};
  start();
  context.host_data = runner.get();
  runner->setHooks({[](void* data, uint32_t work) {
                      EXPECT_EQ(work, 7u);
                      EXPECT_TRUE(static_cast<Runner*>(data)->runTask(0));
                    },
                    nullptr, runner.get()});
  runner->scan();
  EXPECT_EQ(takeTrace(), (Trace{0, 1}));
}

// Others are left out, and what was around them is one step.
TEST_F(RunnerTest, HooksThatHaveWork) {
  test.addChunk(step<0, RUNG_PC_DONE>);
  test.addTask("MAIN", 0);
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 10}, {RUNG_STEP_HOOK, RUNG_NONE, 0}, {RUNG_STEP_ADVANCE, RUNG_NONE, 10},
               {RUNG_STEP_HOOK, RUNG_NONE, 1},     {RUNG_STEP_RUN, 0, 1},          {RUNG_STEP_HOOK, RUNG_NONE, 0},
               {RUNG_STEP_SLOT, RUNG_NONE, 0},     {RUNG_STEP_RUN, 0, 1},          {RUNG_STEP_HOOK, RUNG_NONE, 1}};
  start();
  std::vector<uint32_t> called;
  const auto note = [](void* data, uint32_t work) { static_cast<std::vector<uint32_t>*>(data)->push_back(work); };
  const auto callsOfRest = [&](uint32_t works) {
    runner->setHooks({.step = note, .data = &called, .works = works});
    runner->scan();
    return std::exchange(called, {});
  };
  using Calls = std::vector<uint32_t>;
  EXPECT_EQ(callsOfRest(0b01), (Calls{0, 0}));
  EXPECT_EQ(callsOfRest(0b10), (Calls{1, 1}));
  EXPECT_EQ(callsOfRest(0b00), Calls{});
  EXPECT_EQ(callsOfRest(0b11), (Calls{0, 1, 0, 1}));
  EXPECT_EQ(takeTrace(), (Trace{0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(runner->nowUs(), 80);
  // Within a scan work that is gone is left out at once, and what is new waits for the next one.
  runner->slot();
  EXPECT_FALSE(runner->atListStart());
  EXPECT_EQ(std::exchange(called, {}), (Calls{0, 1, 0}));
  EXPECT_EQ(callsOfRest(0b01), Calls{});
  EXPECT_TRUE(runner->atListStart());
  runner->slot();
  EXPECT_EQ(std::exchange(called, {}), (Calls{0, 0}));
  EXPECT_EQ(callsOfRest(0b11), Calls{});
  EXPECT_EQ(callsOfRest(0b11), (Calls{0, 1, 0, 1}));
  EXPECT_EQ(runner->nowUs(), 140);
}

// Whoever begins a scan by slots and goes on with slices stays in its list.
TEST_F(RunnerTest, SlicesFinishAPassThatSlotsBegan) {
  test.addChunk(step<0, RUNG_PC_DONE>);
  test.addTask("MAIN", 0);
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 4},
               {RUNG_STEP_HOOK, RUNG_NONE, 0},
               {RUNG_STEP_ADVANCE, RUNG_NONE, 4},
               {RUNG_STEP_RUN, 0, 1},
               {RUNG_STEP_SLOT, RUNG_NONE, 0},
               {RUNG_STEP_ADVANCE, RUNG_NONE, 8},
               {RUNG_STEP_RUN, 0, 2}};
  start().setHooks({.works = 0});
  runner->slot();
  EXPECT_EQ(runner->nowUs(), 8);
  EXPECT_EQ(runner->sliceDelayUs(), 8u);
  runner->slice();
  EXPECT_EQ(takeTrace(), (Trace{0, 0, 0}));
  EXPECT_TRUE(runner->atListStart());
  EXPECT_EQ(runner->sliceDelayUs(), 4u) << "the program's own list";
}

TEST_F(RunnerTest, FaultHookRunsOnceBehindTheSafeState) {
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) {
    trace(mem, 0);
    mem[16] = 1;
    ctx->fault = {1, 0, 5, RUNG_NONE};
    return RUNG_PC_FAULT;
  });
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) { // MODULE_HALT with a fault of its own
    trace(mem, 1);
    EXPECT_EQ(mem[16], 0);
    mem[17] = 1;
    ctx->fault = {0, 1, 6, RUNG_NONE};
    return RUNG_PC_FAULT;
  });
  test.addTask("MAIN", 0);
  test.addTask("HALT", 1);
  test.safeSpans = {{16, 2}};
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 10}, {RUNG_STEP_RUN, 0, 3}, {RUNG_STEP_RUN, 0, 1}};
  start();
  runner->setHooks({nullptr, [](void* data) { EXPECT_FALSE(static_cast<Runner*>(data)->runTask(1)); }, runner.get()});
  runner->scan();
  EXPECT_EQ(takeTrace(), (Trace{0, 1}));
  EXPECT_EQ(memory[17], 1); // what the halt task sets stays
  EXPECT_EQ(runner->fault().code, 1u);
  EXPECT_EQ(runner->fault().line, 5u);
  EXPECT_EQ(runner->fault().task, 0u);
  runner->scan();
  runner->slot();
  runner->fast();
  EXPECT_EQ(takeTrace(), Trace{});
  EXPECT_EQ(runner->nowUs(), 10);
}

TEST_F(RunnerTest, StoppedProgramOnlyLetsTheClockGoOn) {
  test.addChunk(step<0, RUNG_PC_DONE>);
  test.addTask("MAIN", 0);
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 10}, {RUNG_STEP_RUN, 0, 1}, {RUNG_STEP_PART, 0, 0}};
  start().setStopped(true);
  runner->scan();
  EXPECT_EQ(takeTrace(), Trace{});
  EXPECT_EQ(runner->nowUs(), 10);
  EXPECT_TRUE(runner->runTask(0)); // by hand
  EXPECT_EQ(takeTrace(), Trace{0});
  runner->setStopped(false);
  runner->scan();
  EXPECT_EQ(takeTrace(), (Trace{0, 0}));
}

TEST_F(RunnerTest, ClockIsFixedInsideATask) {
  test.addChunk(
      [](uint8_t* mem, rung_ctx* ctx, uint32_t) { return mem[0] = static_cast<uint8_t>(ctx->now_us), RUNG_PC_DONE; });
  test.addTask("MAIN", 0);
  test.scan = {{RUNG_STEP_RUN, 0, 1}, {RUNG_STEP_ADVANCE, RUNG_NONE, 20}};
  start().scan();
  EXPECT_EQ(memory[0], 0);
  runner->scan();
  EXPECT_EQ(memory[0], 20);
}

} // namespace
