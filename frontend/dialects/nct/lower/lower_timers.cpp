// TOND, TOFFD, TPULSE (man. §6.4): the register holds the remaining time in milliseconds.
#include <array>
#include <optional>
#include <utility>

#include "frontend/dialects/nct/lower/lower.h"
#include "ir/support/diag/nct.h"
#include "ir/support/diag/operand.h"

namespace rung::frontend::nct {

using ir::RungBuilder;
using ir::SlotId;
using ir::Type;
using ir::ValueId;

namespace {

// Milliseconds per unit and the largest set value, per time basis (l.1353-1385).
constexpr int64_t kUnitMs[] = {1, 1000, 60'000, 3'600'000};
constexpr int64_t kLimit[] = {2'147'483'647, 2'147'483, 35'791, 596};
constexpr int64_t kUsPerMs = 1000;

struct TimerState {
  SlotId active;    // triggered at the last evaluation
  SlotId evaluated; // off-delay only: evaluated at least once
  SlotId since;     // see passedSince; invalid if each run evaluates the timer: it then uses the run's time
};

// Table entry for a basis that is known only at run time.
ValueId choose(RungBuilder& b, ValueId basis, const int64_t (&table)[4]) {
  ValueId value = b.i32(table[3]);
  for (int i = 2; i >= 0; --i) value = b.select(b.eq(basis, b.i32(i)), b.i32(table[i]), value);
  return value;
}

// The set value in milliseconds; a value or basis out of range clears `valid`.
ValueId preset(Lowering& box, ValueId& valid) {
  RungBuilder& b = box.b;
  const Operand& set = box.operands[1];
  const Operand& basis = box.operands[2];
  if (set.form == Form::Constant && basis.form == Form::Constant)
    return b.i32(set.constant.integer * kUnitMs[basis.constant.integer]);
  const ValueId count = box.memory.integer(set, valid);
  ValueId unit;
  ValueId limit;
  if (basis.form == Form::Constant) {
    unit = b.i32(kUnitMs[basis.constant.integer]);
    limit = b.i32(kLimit[basis.constant.integer]);
  } else {
    const ValueId number = box.memory.integer(basis, valid);
    unit = choose(b, number, kUnitMs);
    limit = choose(b, number, kLimit);
    valid = box.memory.both(valid, b.ltU(number, b.i32(4)));
  }
  valid = box.memory.both(valid, b.leU(count, limit)); // unsigned: a negative value is too large
  return b.mul(count, unit);
}

ValueId wholeMs(RungBuilder& b, ValueId us) { return b.divU(us, b.constant(Type::I64, kUsPerMs)); }

// The time as i32, saturated at the largest value of a register (24 days), which ends any timer.
ValueId atMostRegister(RungBuilder& b, ValueId ms) {
  const ValueId most = b.constant(Type::I64, INT32_MAX);
  return b.zextOrTrunc(Type::I32, b.select(b.ltU(ms, most), ms, most));
}

// Time since the last evaluation in milliseconds, for a timer that is not evaluated in every run. The slot `since`
// holds the time, in microseconds, up to which the register has been counted down; fractions of a millisecond count
// later. -1: the timer was never evaluated, or used the run's time before the program was changed; then no time has
// passed yet.
ValueId passedSince(RungBuilder& b, SlotId slot) {
  const ValueId last = b.slotLoad(slot);
  const ValueId since = b.select(b.ltS(last, b.constant(Type::I64, 0)), b.now(), last);
  const ValueId ms = wholeMs(b, b.sub(b.now(), since));
  b.slotStore(slot, b.add(since, b.mul(ms, b.constant(Type::I64, kUsPerMs))));
  return atMostRegister(b, ms);
}

// One evaluation; returns the output. The trigger writes the preset and counts nothing; later evaluations subtract the
// whole milliseconds since the last one. An idle timer's register holds the preset.
ValueId step(Lowering& box, const Place& timer, ValueId presetMs, const TimerState& state) {
  RungBuilder& b = box.b;
  const bool isOffDelay = box.variant == kOffDelay;
  const auto outputOf = [&](ValueId over) { return box.variant == kOnDelay ? over : b.not_(over); };
  const auto outputWhen = [&](bool over) { return b.bit(over == (box.variant == kOnDelay)); };
  const auto begin = [&](bool active) {
    b.slotStore(state.active, b.bit(active));
    if (isOffDelay) b.slotStore(state.evaluated, b.bit(true));
    if (state.since.valid()) b.slotStore(state.since, b.now());
  };
  const auto idle = [&] {
    begin(false);
    box.memory.storeWord(timer, presetMs);
    return b.bit(isOffDelay);
  };
  const auto trigger = [&] {
    // An off-delay that was never evaluated and whose input is off has not been triggered, whatever the register holds.
    const ValueId rest = isOffDelay ? b.select(b.slotLoad(state.evaluated), presetMs, b.i32(0)) : presetMs;
    box.memory.storeWord(timer, rest);
    begin(true);
    return outputOf(b.eq(rest, b.i32(0)));
  };
  // A value that the program wrote into the register is counted down as well.
  const auto count = [&] {
    const ValueId left = box.memory.loadWord(timer);
    const ValueId passed = state.since.valid() ? passedSince(b, state.since) : b.slotLoad(box.time.passedMs);
    box.memory.storeWord(timer, b.sub(left, passed));
    const auto end = [&] {
      box.memory.storeWord(timer, b.i32(0));
      return outputWhen(true);
    };
    return b.choose(b.leS(left, passed), end, [&] { return outputWhen(false); }, ir::kSeldom);
  };
  const ValueId input = box.power();
  const ValueId active = isOffDelay ? b.not_(input) : input;
  return b.choose(active, [&] { return b.choose(b.slotLoad(state.active), count, trigger); }, idle);
}

// A constant or word at a fixed place; nothing if the place is computed.
std::optional<ir::TimerCell> cellOf(Lowering& box, const Operand& operand) {
  if (operand.form == Form::Constant) return ir::TimerCell{};
  const std::optional<ir::Place> place = box.memory.fixedWord(operand.address);
  if (!place) return std::nullopt;
  return ir::TimerCell{.type = Type::I32, .slot = {}, .space = place->space, .byte = place->byte};
}

// For displays: not of a timer whose register is computed; a computed preset or unit is not known.
void describe(Lowering& box, SlotId active) {
  const auto time = cellOf(box, box.operands[0]);
  if (!time) return;
  ir::Timer timer{.flags = RUNG_TIMER_DOWN, .time = *time, .timeUs = kUsPerMs, .running = active};
  const auto preset = cellOf(box, box.operands[1]), basis = cellOf(box, box.operands[2]);
  if (preset && basis) {
    timer.preset = *preset;
    timer.unit = *basis;
    if (preset->type == Type::None) timer.constant = box.operands[1].constant.integer;
    timer.unitsUs.clear();
    for (const int64_t ms : kUnitMs) timer.unitsUs.push_back(static_cast<uint32_t>(ms * kUsPerMs));
    if (basis->type == Type::None) timer.unitsUs = {timer.unitsUs.at(box.operands[2].constant.integer)};
  }
  box.slots.addTimer(std::move(timer));
}

} // namespace

// Time since the previous run, for a task whose runs are whole milliseconds apart.
RunTime lowerRunTime(RungBuilder& b, SlotMaker& slots) {
  const SlotId last = slots.make("last", Type::I64, -1); // time of the previous run; -1: none
  const RunTime time{slots.make("passed", Type::I32, 0, true)};
  const ValueId now = b.now();
  const ValueId before = b.slotLoad(last);
  const ValueId none = b.constant(Type::I64, 0);
  const ValueId passed = b.select(b.ltS(before, none), none, wholeMs(b, b.sub(now, before)));
  b.slotStore(time.passedMs, atMostRegister(b, passed));
  b.slotStore(last, now);
  return time;
}

// An evaluation with invalid operands does not touch the timer, so a timer whose operands may be invalid measures its
// own time.
ValueId lowerTimer(Lowering& box) {
  const Place timer = box.memory.word(box.operands[0].address, AccessBound::User);
  ValueId valid = timer.valid;
  const ValueId presetMs = preset(box, valid);
  TimerState state{.active = box.slots.make("active", Type::Bit), .evaluated = {}, .since = {}};
  describe(box, state.active);
  if (box.variant == kOffDelay) state.evaluated = box.slots.make("evaluated", Type::Bit);
  if (valid.valid() || !box.time.passedMs.valid()) state.since = box.slots.make("since", Type::I64, -1);
  return guarded(box, valid, [&] { return step(box, timer, presetMs, state); });
}

// Checks the set value; its limit depends on the basis.
void checkTimer(std::span<const Operand> operands, const Config&, Diagnostics& diagnostics) {
  const Operand& set = operands[1];
  const Operand& basis = operands[2];
  if (set.form == Form::Constant && !set.fromSymbol && set.constant.integer == 0)
    diagnostics.report(diag::TimerWithoutTime, set.source->range) << operands[0].source->text;
  if (set.form != Form::Constant || basis.form != Form::Constant) return;
  const int64_t limit = kLimit[basis.constant.integer];
  if (set.constant.integer > limit)
    diagnostics.report(diag::ConstantOutOfRange, set.source->range)
        << set.source->text << "0 to " + std::to_string(limit);
}

// CNT and CNTR (man. §6.5).

using ir::RungBuilder;
using ir::ValueId;

namespace {

enum Pins : size_t { kClock, kDown, kClear };

// Loads an operand of 0 to 2147483647; a negative value clears `valid`.
ValueId count(Lowering& box, size_t i, ValueId& valid) {
  const ValueId value = box.memory.integer(box.operands[i], valid);
  if (box.operands[i].form == Form::Constant) return value;
  const ValueId negative = box.b.ltS(value, box.b.i32(0));
  valid = box.memory.both(valid, box.b.not_(negative));
  return value;
}

// The next value. CNT stops at the end value until it is reset (l.1509); CNTR continues at the other end (l.1545-1549).
// The direction rarely changes, so it is a branch.
ValueId counted(Lowering& box, ValueId value, ValueId start, ValueId end) {
  RungBuilder& b = box.b;
  const auto from = [&](ValueId last, ValueId atLast, int32_t step) {
    return [=, &b] { return b.select(b.eq(value, last), atLast, b.add(value, b.i32(step))); };
  };
  const ValueId down = box.power(kDown);
  if (box.variant == kStopping) return b.choose(down, from(end, value, -1), from(end, value, 1));
  return b.choose(down, from(start, end, -1), from(end, start, 1));
}

} // namespace

// The reset has priority over the clock; the clock's edge is stored in any case. Most scans have neither, and leave the
// counter unchanged.
ValueId lowerCounter(Lowering& box) {
  RungBuilder& b = box.b;
  const ValueId edge = risingEdge(box, "clock", kClock);
  const Place counter = box.memory.word(box.operands[0].address, AccessBound::User);
  ValueId valid = counter.valid;
  const ValueId start = count(box, 1, valid);
  const ValueId end = count(box, 2, valid);
  const ValueId compare = count(box, 3, valid);
  if (box.variant == kRing) valid = box.memory.both(valid, b.leS(start, end));
  const auto put = [&](ValueId value) {
    box.memory.storeWord(counter, value);
    return b.eq(value, compare);
  };
  const auto step = [&] {
    const ValueId value = box.memory.loadWord(counter);
    const auto count = [&] { return put(counted(box, value, start, end)); };
    return b.choose(edge, count, [&] { return b.eq(value, compare); });
  };
  return guarded(box, valid, [&] { return b.choose(box.power(kClear), [&] { return put(start); }, step); });
}

} // namespace rung::frontend::nct
