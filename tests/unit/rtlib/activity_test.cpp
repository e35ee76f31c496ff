// Chunks that would change nothing are left out: when they rest, what wakes them, and that nothing else is different.
#include "rtlib/core/activity.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <vector>

#include "rtlib/core/runner.h"
#include "rtlib/host/activity_memory.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung;
using test::TestProgram;
using Trace = std::vector<int>;

// Chunks write their number into a trace at the end of the memory, which nobody watches: mem[200] is its length.
void trace(uint8_t* mem, uint8_t number) { mem[201 + mem[200]++] = number; }

// mem[To] := mem[From] + Plus
template <uint8_t N, uint8_t From, uint8_t To, uint8_t Plus = 0>
uint32_t move(uint8_t* mem, rung_ctx*, uint32_t chunk) {
  trace(mem, N);
  mem[To] = static_cast<uint8_t>(mem[From] + Plus);
  return chunk + 1;
}
uint32_t done(uint8_t* mem, rung_ctx*, uint32_t) {
  trace(mem, 9);
  return RUNG_PC_DONE;
}

class ActivityTest : public testing::Test {
protected:
  static constexpr uint32_t kHeavy = 1000; // looking pays

  template <uint8_t N, uint8_t From, uint8_t To, uint8_t Plus = 0>
  void addMove(uint32_t weight = kHeavy) {
    test.addChunk(&move<N, From, To, Plus>, weight);
    if (From < To)
      test.addActivity({{To, 1}}, {{From, 1}, {To, 1}});
    else if (From > To)
      test.addActivity({{To, 1}}, {{To, 1}, {From, 1}});
    else
      test.addActivity({{To, 1}}, {{To, 1}});
  }
  // The last chunk, which always runs.
  void start(uint32_t budget = 1'000'000) {
    test.addChunk(&done, kHeavy);
    test.addActivity({}, {});
    task = test.addTask("MAIN", 0, budget);
    test.program.main_task = task;
    parts.resize(test.tasks.size());
    memory.assign(test.memorySize, 0);
    const rung_program& program = test.link();
    watched = std::make_unique<host::ActivityMemory>(program);
    activity = watched->make();
    runner = std::make_unique<rt::Runner>(program, memory.data(), context, parts.data());
    runner->setActivity(&activity);
    runner->reset();
  }
  Trace run() {
    memory[200] = 0;
    EXPECT_TRUE(runner->runTask(task));
    return {memory.begin() + 201, memory.begin() + 201 + memory[200]};
  }

  TestProgram test;
  rung_ctx context{};
  std::vector<rt::PartState> parts;
  std::vector<uint8_t> memory;
  std::unique_ptr<host::ActivityMemory> watched;
  rt::Activity activity;
  std::unique_ptr<rt::Runner> runner;
  uint32_t task = 0;
};

TEST_F(ActivityTest, RestsOnceARunHasChangedNothing) {
  addMove<0, 1, 20>();
  addMove<1, 20, 40>();
  addMove<2, 2, 60>();
  addMove<3, 2, 61>();
  start();
  EXPECT_EQ(run(), (Trace{0, 1, 2, 3, 9})); // 0 to 0 everywhere
  EXPECT_EQ(run(), (Trace{9}));
}

TEST_F(ActivityTest, LooksSeldomWhereThatDoesNotPay) {
  addMove<0, 1, 20>(1);
  addMove<1, 20, 40>(1);
  addMove<2, 2, 60>(1);
  start();
  test.weights.back() = 1;
  test.link();
  watched = std::make_unique<host::ActivityMemory>(test.program);
  activity = watched->make();
  // The first run of two finds what rests, the second one what that saves.
  for (const int pause : {31, 63, 127, 255, 511, 511}) {
    run();
    EXPECT_EQ(run(), (Trace{9}));
    for (int i = 0; i < pause; ++i) ASSERT_EQ(run(), (Trace{0, 1, 2, 9})) << i;
  }
}

class Resting : public ActivityTest {
protected:
  void rest() {
    for (int i = 0; i < 3; ++i) run();
    EXPECT_EQ(run(), (Trace{9}));
  }
};

TEST_F(Resting, AnyoneWhoWritesWakesThoseWhoRead) {
  addMove<0, 1, 20>();
  addMove<1, 20, 40>();
  addMove<2, 2, 60>();
  addMove<3, 3, 61>();
  start();
  rest();
  memory[1] = 7;
  EXPECT_EQ(run(), (Trace{0, 1, 9})) << "what the first one changes, the second one sees in the same run";
  EXPECT_EQ(memory[40], 7);
  EXPECT_EQ(run(), (Trace{0, 1, 9})) << "they have changed something, so they are looked at once more";
  EXPECT_EQ(run(), (Trace{9}));
  memory[61] = 5; // an output that somebody else has written
  EXPECT_EQ(run(), (Trace{3, 9}));
  EXPECT_EQ(memory[61], 0);
}

TEST_F(Resting, WhatReadsABoveItsWriterSeesItInTheNextRun) {
  addMove<0, 40, 20>();
  addMove<1, 1, 40>();
  addMove<2, 2, 60>();
  addMove<3, 3, 61>();
  start();
  rest();
  memory[1] = 7;
  EXPECT_EQ(run(), (Trace{1, 9}));
  EXPECT_EQ(memory[20], 0);
  EXPECT_EQ(run(), (Trace{0, 1, 9}));
  EXPECT_EQ(memory[20], 7);
}

TEST_F(Resting, WhereMuchChangesAllRuns) {
  addMove<0, 1, 20>(40);
  addMove<1, 2, 40>(40);
  addMove<2, 3, 60>(40);
  addMove<3, 4, 61>();
  start();
  rest();
  for (uint8_t at = 1; at < 12; ++at) memory[at] = 7; // few enough for looking to go on
  for (int i = 0; i < 2; ++i) EXPECT_EQ(run(), (Trace{0, 1, 2, 3, 9})) << "first without a look, then with a new copy";
  EXPECT_EQ(run(), (Trace{9}));
  EXPECT_EQ(memory[20] + memory[40] + memory[60] + memory[61], 28);
}

// A byte that two of them write, and one in between reads: each run changes it twice.
class Relayed : public Resting {
protected:
  void SetUp() override {
    addMove<0, 1, 20>();
    addMove<1, 20, 40>();
    addMove<2, 2, 20>();
    addMove<3, 20, 60>();
    addMove<4, 5, 61>();
    start();
    memory[1] = 7;
    memory[2] = 1;
    for (int i = 0; i < 3; ++i) run();
  }
};

TEST_F(Relayed, ThoseWhoTouchItRest) {
  EXPECT_EQ(run(), (Trace{9}));
  EXPECT_EQ(memory[20], 1);
  EXPECT_EQ(memory[40], 7);
  EXPECT_EQ(memory[60], 1);
}

TEST_F(Relayed, WhatOneLeavesOtherwiseWakesTheNext) {
  memory[1] = 8;
  EXPECT_EQ(run(), (Trace{0, 1, 2, 9})) << "the third one found 8 where it had found 7, and left the same";
  EXPECT_EQ(memory[20], 1);
  EXPECT_EQ(memory[40], 8);
  memory[2] = 3;
  EXPECT_EQ(run(), (Trace{1, 2, 3, 9})) << "the second one has changed something in the run before";
  EXPECT_EQ(memory[20], 3);
  EXPECT_EQ(run(), (Trace{0, 3, 9})) << "the first one finds 3 where it had found 1";
  EXPECT_EQ(run(), (Trace{9}));
  EXPECT_EQ(memory[20], 3);
  EXPECT_EQ(memory[40], 8);
  EXPECT_EQ(memory[60], 3);
}

TEST_F(Relayed, AnyoneWhoWritesItWakesTheFirst) {
  memory[20] = 9;
  EXPECT_EQ(run(), (Trace{0, 9}));
  EXPECT_EQ(memory[20], 1);
  EXPECT_EQ(memory[40], 7);
  EXPECT_EQ(run(), (Trace{0, 9})) << "it finds 1 again";
  EXPECT_EQ(run(), (Trace{9}));
}

TEST_F(Relayed, AFaultLeavesWhatWasLeftBeforeIt) {
  EXPECT_EQ(run(), (Trace{9}));
  test.functions[1] = [](uint8_t* mem, rung_ctx*, uint32_t) {
    EXPECT_EQ(mem[20], 7);
    return RUNG_PC_FAULT;
  };
  memory[40] = 5; // wakes the second one
  EXPECT_FALSE(runner->runTask(task));
  EXPECT_EQ(memory[20], 7);
}

TEST_F(Resting, ACounterNeverRests) {
  addMove<0, 20, 20, 1>();
  addMove<1, 2, 40>();
  addMove<2, 3, 60>();
  addMove<3, 4, 61>();
  start();
  for (int i = 0; i < 3; ++i) run();
  const uint8_t before = memory[20];
  EXPECT_EQ(run(), (Trace{0, 9}));
  EXPECT_EQ(memory[20], before + 1);
}

// ---- timers

constexpr uint32_t kCell = 20, kAmount = 48, kInput = 1, kOutput = 60;

int32_t word(const uint8_t* mem, uint32_t at) {
  int32_t value;
  std::memcpy(&value, mem + at, sizeof value);
  return value;
}
void setWord(uint8_t* mem, uint32_t at, int32_t value) { std::memcpy(mem + at, &value, sizeof value); }

// On delay: while the input is on, the cell comes down from 100 by the amount of each run.
uint32_t timer(uint8_t* mem, rung_ctx*, uint32_t chunk) {
  trace(mem, 1);
  mem[kOutput] = 0;
  if (mem[kInput] == 0) {
    setWord(mem, kCell, 100);
  } else {
    const int32_t left = word(mem, kCell), amount = word(mem, kAmount);
    setWord(mem, kCell, left <= amount ? 0 : left - amount);
    mem[kOutput] = left <= amount ? 1 : 0;
  }
  return chunk + 1;
}

class RunningTimer : public Resting {
protected:
  // move 0, the timer, move 2 and 3, and one that always runs.
  void SetUp() override {
    addMove<0, 2, 40>();
    test.addChunk(&timer, kHeavy);
    test.addActivity({{kCell, 4}, {kOutput, 1}}, {{kInput, 1}, {kCell, 4}, {kAmount, 4}, {kOutput, 1}});
    test.addTimer({.cell = kCell, .amount = kAmount, .size = 4, .down = 1, .limit_cell = RUNG_NONE});
    addMove<2, 3, 61>();
    addMove<3, kOutput, 62>();
    start();
    setWord(memory.data(), kAmount, 10);
    rest();
    EXPECT_EQ(word(memory.data(), kCell), 100);
  }
  int32_t cell() const { return word(memory.data(), kCell); }
};

TEST_F(RunningTimer, RestsUntilItsTimeIsOver) {
  memory[kInput] = 1;
  EXPECT_EQ(run(), (Trace{1, 9})) << "the first run that moves it on";
  EXPECT_EQ(run(), (Trace{1, 9})) << "the second one does nothing else";
  for (int32_t left = 70; left > 0; left -= 10) {
    EXPECT_EQ(run(), (Trace{9}));
    EXPECT_EQ(cell(), left) << "moved on as if it ran";
  }
  EXPECT_EQ(memory[kOutput], 0);
  EXPECT_EQ(run(), (Trace{1, 3, 9}));
  EXPECT_EQ(cell(), 0);
  EXPECT_EQ(memory[62], 1);
  run();
  EXPECT_EQ(run(), (Trace{9})) << "over, it rests like others";
  EXPECT_EQ(cell(), 0);
}

TEST_F(RunningTimer, WakesWhenSomebodyWritesWhatItReads) {
  memory[kInput] = 1;
  for (int i = 0; i < 3; ++i) run();
  EXPECT_EQ(cell(), 70);
  setWord(memory.data(), kCell, 35);
  EXPECT_EQ(run(), (Trace{1, 9}));
  EXPECT_EQ(cell(), 25);
  run();
  EXPECT_EQ(cell(), 15);
  setWord(memory.data(), kAmount, 3);
  EXPECT_EQ(run(), (Trace{1, 9}));
  EXPECT_EQ(cell(), 12);
  run();
  EXPECT_EQ(run(), (Trace{9}));
  EXPECT_EQ(cell(), 6);
  memory[kInput] = 0;
  EXPECT_EQ(run(), (Trace{1, 9}));
  EXPECT_EQ(cell(), 100);
}

// Woken in a run after it has been passed, or before.
TEST_F(RunningTimer, IsMovedOnOnceInARunThatWakesIt) {
  memory[kInput] = 1;
  for (int i = 0; i < 3; ++i) run();
  EXPECT_EQ(cell(), 70);
  test.functions[2] = [](uint8_t* mem, rung_ctx*, uint32_t chunk) {
    trace(mem, 2);
    setWord(mem, kAmount, mem[3]);
    return chunk + 1;
  };
  test.activitySpans[test.activity[2].written_first] = {kAmount, 4};
  memory[3] = 5;
  test.link();
  watched = std::make_unique<host::ActivityMemory>(test.program);
  activity = watched->make();
  setWord(memory.data(), kCell, 1000);
  setWord(memory.data(), kAmount, 5);
  for (int i = 0; i < 4; ++i) run();
  EXPECT_EQ(run(), (Trace{9}));
  EXPECT_EQ(cell(), 975);
  memory[3] = 7;
  EXPECT_EQ(run(), (Trace{2, 9})) << "it went by the amount of before";
  EXPECT_EQ(cell(), 970);
  EXPECT_EQ(run(), (Trace{1, 2, 9}));
  EXPECT_EQ(cell(), 963);
}

TEST_F(RunningTimer, AChangeThatLooksLikeAStepIsNone) {
  setWord(memory.data(), kCell, 110);
  EXPECT_EQ(run(), (Trace{1, 9}));
  EXPECT_EQ(cell(), 100) << "its input is off: it stores 100";
  run();
  EXPECT_EQ(run(), (Trace{9}));
  EXPECT_EQ(cell(), 100);
}

// Looking does not pay, so it ends while the timer is moved on, and begins again.
TEST_F(RunningTimer, GoesOnWhereLookingEnds) {
  test.weights.assign(test.functions.size(), 1);
  test.link();
  watched = std::make_unique<host::ActivityMemory>(test.program);
  activity = watched->make();
  memory[kInput] = 1;
  setWord(memory.data(), kCell, 10'000);
  bool moved = false;
  for (int32_t i = 1; i < 300; ++i) {
    const Trace ran = run();
    moved = moved || ran.front() != 1;
    ASSERT_EQ(cell(), 10'000 - 10 * i) << i;
  }
  EXPECT_TRUE(moved);
}

TEST_F(RunningTimer, AFaultEndsARunBetweenChunks) {
  memory[kInput] = 1;
  for (int i = 0; i < 3; ++i) run();
  test.functions.back() = [](uint8_t*, rung_ctx*, uint32_t) { return RUNG_PC_FAULT; };
  memory[200] = 0;
  EXPECT_FALSE(runner->runTask(task));
  EXPECT_EQ(cell(), 60) << "before the fault";
}

TEST_F(RunningTimer, WhatAFaultComesBeforeIsNotMovedOn) {
  memory[kInput] = 1;
  for (int i = 0; i < 3; ++i) run();
  test.functions.front() = [](uint8_t*, rung_ctx*, uint32_t) { return RUNG_PC_FAULT; };
  memory[2] = 1; // wakes it
  EXPECT_FALSE(runner->runTask(task));
  EXPECT_EQ(cell(), 70);
}

TEST_F(Resting, OtherCodeWakesAll) {
  addMove<0, 1, 20>();
  addMove<1, 2, 40>();
  start();
  rest();
  const std::vector<rung_chunk_fn> other = {&move<5, 1, 20, 3>, &move<6, 2, 40, 3>, &done};
  runner->force({other.data(), nullptr}, {});
  EXPECT_EQ(run(), (Trace{5, 6, 9}));
  EXPECT_EQ(memory[20], 3);
  runner->endForces();
  EXPECT_EQ(run(), (Trace{0, 1, 9}));
  EXPECT_EQ(memory[20], 0);
}

TEST_F(Resting, CountsForTheBudgetAsIfItRan) {
  addMove<0, 1, 20>(3000);
  addMove<1, 2, 40>(4000);
  start(7000 + kHeavy);
  rest();
  EXPECT_EQ(run(), (Trace{9}));
  --test.tasks[task].budget;
  EXPECT_FALSE(runner->runTask(task));
  EXPECT_TRUE(runner->faulted());
}

} // namespace
