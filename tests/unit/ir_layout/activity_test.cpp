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

constexpr uint32_t kRungs = 40;
constexpr uint32_t kBytes = 24; // of bits
constexpr SpaceId kBits{0}, kWords{1}, kTimes{2}, kImage{2}, kMarks{3};

struct Ran {
  uint64_t all = 0;
  uint64_t active = 0;
  uint32_t timers = 0; // that a host can move on
};

// Most scans come without a change, so that there is time to rest. In some programs somebody writes one byte the same
// in every scan, whatever the program has left there.
Ran compareScans(const Module& module, uint64_t seed) {
  const Layout layout(module, {.cut = {.maxChunkRungs = 1 + static_cast<uint32_t>(seed % 3)}});
  Running all(layout, false);
  Running active(layout, true);
  RandomSource random(seed);
  const bool holds = random.chance(25);
  const uint32_t heldSpace = kImage.index < module.spaces.size() && random.chance(75) ? kImage.index : kBits.index;
  const uint32_t heldByte = random.below(module.spaces[heldSpace].unitBytes * module.spaces[heldSpace].units);
  const auto held = static_cast<uint8_t>(random.next());
  for (int scan = 0; scan < 300; ++scan) {
    const uint32_t space = random.below(static_cast<uint32_t>(module.spaces.size()));
    const uint32_t byte = random.below(module.spaces[space].unitBytes * module.spaces[space].units);
    const auto value = static_cast<uint8_t>(random.next());
    const bool writes = random.chance(4);
    for (Running* running : {&all, &active}) {
      if (writes) running->instance->memory().writeByte(space, byte, value);
      if (holds) running->instance->memory().writeByte(heldSpace, heldByte, held);
      running->instance->scan();
    }
    const auto difference = host::firstDifference(*all.instance, *active.instance, nc::describe);
    EXPECT_FALSE(difference) << "scan " << scan << ": " << *difference;
    if (difference) break;
  }
  return {all.rungs, active.rungs, active.program.timer_count};
}

// Weights of rungs: looking pays; and it does where little changes.
constexpr uint32_t kHeavy = 1000;
constexpr uint32_t kLight = 60;

enum class Kind : uint8_t {
  Plain,
  FromImage, // a run takes the bits from an image and gives back those that rungs have written
  Timers,    // one rung in four has one
};

// The time of each run, which the first rung takes: 0 to 3 ms, as a word of the machine says.
SlotId addRunTime(Module& module, Rung& rung) {
  module.slots.push_back({.type = Type::I64, .key = "amount"});
  const SlotId amount{static_cast<uint32_t>(module.slots.size() - 1)};
  RungBuilder b(module, rung);
  const ValueId word = b.zextOrTrunc(Type::I64, b.load(Type::I16, {kWords, 0, 0}));
  b.slotStore(amount, b.and_(word, b.constant(Type::I64, 3)));
  return amount;
}

SlotId addSlot(Module& module, Type type, int64_t init) {
  module.slots.push_back({.type = type, .init = init, .key = "s" + std::to_string(module.slots.size())});
  return SlotId{static_cast<uint32_t>(module.slots.size() - 1)};
}

// As NCT has it: a register that comes down to 0.
ValueId timerDown(Module& module, RungBuilder& b, ValueId input, uint32_t number, SlotId amount) {
  const Place cell{kTimes, 8 * number, 0};
  const SlotId active = addSlot(module, Type::Bit, 0);
  const ValueId preset = b.constant(Type::I64, 5 + 7 * number);
  const auto count = [&] {
    const ValueId left = b.load(Type::I64, cell);
    const ValueId passed = b.slotLoad(amount);
    b.store(cell, b.sub(left, passed));
    const auto end = [&] {
      b.store(cell, b.constant(Type::I64, 0));
      return b.bit(true);
    };
    return b.choose(b.leS(left, passed), end, [&] { return b.bit(false); });
  };
  const auto begin = [&](bool on) {
    b.store(cell, preset);
    b.slotStore(active, b.bit(on));
    return b.bit(false);
  };
  return b.choose(
      input, [&] { return b.choose(b.slotLoad(active), count, [&] { return begin(true); }); },
      [&] { return begin(false); });
}

// As GSK has it: a slot that grows to a preset, which is a constant or a word of the program.
ValueId timerUp(Module& module, RungBuilder& b, ValueId input, uint32_t number, SlotId amount) {
  const SlotId elapsed = addSlot(module, Type::I64, -1'000'000);
  const ValueId zero = b.constant(Type::I64, 0);
  const auto grow = [&] {
    const ValueId word = b.load(Type::I16, {kWords, 2 + 2 * (number % 3), 0});
    const ValueId preset =
        number % 2 == 0 ? b.constant(Type::I64, 40) : b.mul(b.zextOrTrunc(Type::I64, word), b.constant(Type::I64, 9));
    const ValueId grown = b.add(b.slotLoad(elapsed), b.slotLoad(amount));
    b.slotStore(elapsed, grown);
    const auto start = [&] {
      b.slotStore(elapsed, zero);
      return zero;
    };
    return b.leS(preset, b.choose(b.ltS(grown, zero), start, [&] { return grown; }));
  };
  return b.choose(input, grow, [&] {
    b.slotStore(elapsed, b.constant(Type::I64, -1'000'000));
    return b.bit(false);
  });
}

// Ladders: each rung writes the combination of three bits to a fourth, which others read and may write too; some leap
// over the next ones, some add to a word.
Module ladder(uint64_t seed, Kind kind) {
  RandomSource random(seed);
  Module module;
  module.files = {"a"};
  module.faults = {"F"};
  module.spaces = {{.name = "B", .unitBytes = 1, .units = kBytes}, {.name = "W", .unitBytes = 2, .units = 4}};
  module.routines.push_back({.name = "R", .rungs = std::vector<Rung>(kRungs)});
  module.tasks.push_back({.name = "T", .entry = RoutineId{0}, .budgetFault = FaultId{0}});
  module.mainTask = TaskId{0};
  module.scan = {{.op = RUNG_STEP_ADVANCE, .task = {}, .arg = 1000}, {.task = TaskId{0}}};
  const bool fromImage = kind == Kind::FromImage;
  if (fromImage) {
    module.spaces.push_back({.name = "I", .unitBytes = 1, .units = kBytes});
    module.spaces.push_back({.name = "M", .unitBytes = 1, .units = kBytes});
    module.tasks[0].begin = {{.from = {kImage, 0, kBytes}, .to = kBits}};
    module.tasks[0].end = {{.masked = true, .from = {kBits, 0, kBytes}, .to = kImage, .mask = kMarks}};
  }
  if (kind == Kind::Timers) {
    module.spaces.push_back({.name = "T", .unitBytes = 8, .units = kRungs});
    module.inits.push_back({.space = kWords, .data = {1, 0}}); // the time goes on
  }
  const auto anyBit = [&] { return Place{kBits, random.below(kBytes), random.below(8)}; };
  SlotId amount;
  std::vector<uint32_t> registers;
  for (uint32_t i = 0; i < kRungs; ++i) {
    Rung& rung = module.routines[0].rungs[i];
    rung.key = i + 1;
    rung.weight = seed % 2 == 0 ? kHeavy : kLight;
    if (kind == Kind::Timers && i == 0) {
      amount = addRunTime(module, rung);
      continue;
    }
    RungBuilder b(module, rung);
    const ValueId first = b.load(Type::Bit, anyBit());
    const ValueId second = b.load(Type::Bit, anyBit());
    const ValueId third = b.load(Type::Bit, anyBit());
    ValueId power = b.and_(b.or_(first, second), random.chance(50) ? third : b.not_(third));
    if (kind == Kind::Timers && random.chance(25)) {
      const bool down = random.chance(50);
      power = down ? timerDown(module, b, power, i, amount) : timerUp(module, b, power, i, amount);
      if (down) registers.push_back(i);
    } else if (!registers.empty() && random.chance(3)) { // what another timer has left
      const uint32_t number = registers[random.below(static_cast<uint32_t>(registers.size()))];
      const ValueId odd = b.and_(b.load(Type::I64, {kTimes, 8 * number, 0}), b.constant(Type::I64, 1));
      power = b.eq(odd, b.constant(Type::I64, 1));
    }
    const Place coil = anyBit();
    b.store(coil, power);
    if (fromImage) b.store({kMarks, coil.byte, coil.bit}, b.constant(Type::Bit, 1));
    if (random.chance(10)) {
      const Place word{kWords, 2 * random.below(4), 0};
      b.if_(power);
      b.store(word, b.add(b.load(Type::I16, word), b.constant(Type::I16, 1)));
      b.endIf({});
    }
    if (i + 3 < kRungs && random.chance(10))
      rung.transfer = {.kind = TransferKind::Goto, .cond = power, .target = i + 1 + random.below(3)};
  }
  return module;
}

class LadderWithActivity : public testing::TestWithParam<Kind> {};

TEST_P(LadderWithActivity, DoesTheSameAndRests) {
  Ran sum;
  for (uint64_t seed = 0; seed < 200 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Module module = ladder(seed, GetParam());
    module.activity = true;
    const Ran ran = compareScans(module, seed);
    sum.all += ran.all;
    sum.active += ran.active;
    sum.timers += ran.timers;
  }
  EXPECT_LT(sum.active, sum.all / 10 * 7) << "hardly anything rested, so nothing was tested";
  EXPECT_EQ(sum.timers > 300, GetParam() == Kind::Timers);
}
INSTANTIATE_TEST_SUITE_P(Kinds, LadderWithActivity, testing::Values(Kind::Plain, Kind::FromImage, Kind::Timers));

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
