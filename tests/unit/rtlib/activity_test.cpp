// Chunks that would change nothing are left out: when they rest, what wakes them, and that nothing else is different.
#include "rtlib/core/activity.h"

#include <gtest/gtest.h>

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

TEST_F(Resting, TwoWhoWriteTheSameNeverRestWhileTheyDiffer) {
  addMove<0, 1, 20>();
  addMove<1, 2, 20>();
  addMove<2, 3, 60>();
  addMove<3, 4, 61>();
  addMove<4, 5, 62>();
  addMove<5, 6, 63>();
  start();
  rest();
  memory[2] = 1;
  run();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(run(), (Trace{0, 1, 9}));
  memory[1] = 1;
  run();
  run();
  EXPECT_EQ(run(), (Trace{9}));
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
