// Chunks that rest: a program that leaves them out does what one does that runs them all, whoever writes when.
#include <gtest/gtest.h>

#include <memory>

#include "ir/core/builder.h"
#include "ir/interp/interp.h"
#include "rtlib/host/compare.h"
#include "rtlib/host/instance.h"
#include "rtlib/nc/names/names.h"
#include "tests/random/random.h"
#include "tests/random/random_source.h"

namespace rung::ir {
namespace {

class Counter final : public RungObserver {
public:
  explicit Counter(uint64_t& count) : count_(count) {}
  void rungRan(uint32_t, std::span<const uint64_t>) override { ++count_; }

private:
  uint64_t& count_;
};

// The interpreter's own table says that everything runs.
struct Running {
  Running(const Layout& layout, bool active) : engine(layout, 0), program(engine.program()) {
    engine.setObserver(std::make_unique<Counter>(rungs));
    if (active) program.activity_count = program.chunk_count;
    instance = std::make_unique<host::Instance>(host::Runnable{program, engine.context()});
  }
  uint64_t rungs = 0;
  InterpEngine engine;
  rung_program program;
  std::unique_ptr<host::Instance> instance;
};

struct Ran {
  uint64_t all = 0;
  uint64_t active = 0;
};

// Most scans come without a change, so that there is time to rest.
Ran compareScans(const Module& module, uint64_t seed) {
  const Layout layout(module, {.cut = {.maxChunkRungs = 1 + static_cast<uint32_t>(seed % 3)}});
  Running all(layout, false);
  Running active(layout, true);
  RandomSource random(seed);
  for (int scan = 0; scan < 300; ++scan) {
    const uint32_t space = random.below(static_cast<uint32_t>(module.spaces.size()));
    const uint32_t byte = random.below(module.spaces[space].unitBytes * module.spaces[space].units);
    const auto value = static_cast<uint8_t>(random.next());
    const bool writes = random.chance(4);
    for (Running* running : {&all, &active}) {
      if (writes) running->instance->memory().writeByte(space, byte, value);
      running->instance->scan();
    }
    const auto difference = host::firstDifference(*all.instance, *active.instance, nc::describe);
    EXPECT_FALSE(difference) << "scan " << scan << ": " << *difference;
    if (difference) break;
  }
  return {all.rungs, active.rungs};
}

// Weights of rungs: looking pays; and it does where little changes.
constexpr uint32_t kHeavy = 1000;
constexpr uint32_t kLight = 60;

// Ladders: each rung writes the combination of three bits to a fourth, which others read and may write too; some leap
// over the next ones, some add to a word. `fromImage`: a run takes the bits from an image and gives back those that
// rungs have written.
Module ladder(uint64_t seed, bool fromImage = false) {
  constexpr uint32_t kRungs = 40;
  constexpr uint32_t kBytes = 24; // of bits
  RandomSource random(seed);
  Module module;
  module.files = {"a"};
  module.faults = {"F"};
  module.spaces = {{.name = "B", .unitBytes = 1, .units = kBytes}, {.name = "W", .unitBytes = 2, .units = 4}};
  module.routines.push_back({.name = "R", .rungs = std::vector<Rung>(kRungs)});
  module.tasks.push_back({.name = "T", .entry = RoutineId{0}, .budgetFault = FaultId{0}});
  module.mainTask = TaskId{0};
  module.scan = {{.op = RUNG_STEP_ADVANCE, .task = {}, .arg = 1000}, {.task = TaskId{0}}};
  constexpr SpaceId kBits{0}, kImage{2}, kMarks{3};
  if (fromImage) {
    module.spaces.push_back({.name = "I", .unitBytes = 1, .units = kBytes});
    module.spaces.push_back({.name = "M", .unitBytes = 1, .units = kBytes});
    module.tasks[0].begin = {{.from = {kImage, 0, kBytes}, .to = kBits}};
    module.tasks[0].end = {{.masked = true, .from = {kBits, 0, kBytes}, .to = kImage, .mask = kMarks}};
  }
  const auto anyBit = [&] { return Place{SpaceId{0}, random.below(kBytes), random.below(8)}; };
  for (uint32_t i = 0; i < kRungs; ++i) {
    Rung& rung = module.routines[0].rungs[i];
    rung.key = i + 1;
    rung.weight = seed % 2 == 0 ? kHeavy : kLight;
    RungBuilder b(module, rung);
    const ValueId first = b.load(Type::Bit, anyBit());
    const ValueId second = b.load(Type::Bit, anyBit());
    const ValueId third = b.load(Type::Bit, anyBit());
    const ValueId power = b.and_(b.or_(first, second), random.chance(50) ? third : b.not_(third));
    const Place coil = anyBit();
    b.store(coil, power);
    if (fromImage) b.store({kMarks, coil.byte, coil.bit}, b.constant(Type::Bit, 1));
    if (random.chance(10)) {
      const Place word{SpaceId{1}, 2 * random.below(4), 0};
      b.if_(power);
      b.store(word, b.add(b.load(Type::I16, word), b.constant(Type::I16, 1)));
      b.endIf({});
    }
    if (i + 3 < kRungs && random.chance(10))
      rung.transfer = {.kind = TransferKind::Goto, .cond = power, .target = i + 1 + random.below(3)};
  }
  return module;
}

class LadderWithActivity : public testing::TestWithParam<bool> {};

TEST_P(LadderWithActivity, DoesTheSameAndRests) {
  Ran sum;
  for (uint64_t seed = 0; seed < 200 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Module module = ladder(seed, GetParam());
    module.activity = true;
    const Ran ran = compareScans(module, seed);
    sum.all += ran.all;
    sum.active += ran.active;
  }
  EXPECT_LT(sum.active, sum.all / 10 * 7) << "hardly anything rested, so nothing was tested";
}
INSTANTIATE_TEST_SUITE_P(OfAnImage, LadderWithActivity, testing::Bool());

// Calls, loops, computed addresses, messages, services, faults: little of it rests.
TEST(Activity, ARandomProgramDoesTheSame) {
  for (uint64_t seed = 0; seed < 200 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Module module = randomModule(seed, {.rungs = 24, .ops = 8});
    module.activity = true;
    for (Task& each : module.tasks) each.budget *= kHeavy;
    for (Routine& routine : module.routines)
      for (Rung& rung : routine.rungs) rung.weight *= kHeavy;
    compareScans(module, seed);
  }
}

} // namespace
} // namespace rung::ir
