// TOND, TOFFD, TPULSE (man. §6.4): the register holds the time that remains, in milliseconds.
#include "frontend/dialects/nct/lowering.h"

namespace rung::nct {

using ir::OpCode;
using ir::RungBuilder;
using ir::SlotId;
using ir::Type;
using ir::ValueId;

namespace {

// By time basis: milliseconds a unit, and the greatest set value (l.1353-1385).
constexpr int64_t kUnitMs[] = {1, 1000, 60'000, 3'600'000};
constexpr int64_t kLimit[] = {2'147'483'647, 2'147'483, 35'791, 596};

// The entry of a table for a basis that is known at run time only.
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

struct TimerState {
  SlotId active; // triggered at the last evaluation
  SlotId since;  // what the register has been counted down to, in microseconds; -1: never evaluated
};

// One evaluation; gives the output. The trigger writes the preset and counts nothing; afterwards the register loses
// the whole milliseconds since the last evaluation, the rest stays in `since`. Idle, it holds the preset.
ValueId step(Lowering& box, const Place& timer, ValueId presetMs, const TimerState& state) {
  RungBuilder& b = box.b;
  const ValueId input = box.power();
  const ValueId active = box.variant == kOffDelay ? b.not_(input) : input;
  ValueId counting = b.and_(active, b.slotLoad(state.active));
  b.slotStore(state.active, active);
  const ValueId since = b.slotLoad(state.since);
  const ValueId now = b.now();
  const ValueId passedMs = b.op(OpCode::DivS, Type::I64, {b.sub(now, since), b.constant(Type::I64, 1000)});
  const ValueId left = b.sub(b.sextOrTrunc(Type::I64, box.memory.loadWord(timer)), passedMs);
  const ValueId none = b.i32(0);
  const ValueId counted = b.select(b.ltS(left, b.constant(Type::I64, 0)), none, b.zextOrTrunc(Type::I32, left));
  ValueId rest = presetMs;
  if (box.variant == kOffDelay) {
    // Never evaluated and its input is off: it has not been triggered, whatever the register holds.
    const ValueId first = b.ltS(since, b.constant(Type::I64, 0));
    rest = b.select(b.and_(first, counting), none, rest);
    counting = b.and_(counting, b.not_(first));
  }
  const ValueId value = b.select(counting, counted, rest);
  const ValueId countedTo = b.add(since, b.mul(passedMs, b.constant(Type::I64, 1000)));
  b.slotStore(state.since, b.select(counting, countedTo, now));
  box.memory.storeWord(timer, value);
  const ValueId over = b.eq(value, none);
  switch (static_cast<TimerVariant>(box.variant)) {
  case kOnDelay: return b.and_(active, over);
  case kOffDelay: return b.or_(input, b.not_(over));
  case kTimedPulse: return b.and_(active, b.not_(over));
  }
  return {};
}

} // namespace

ValueId lowerTimer(Lowering& box) {
  const TimerState state{box.slots.make("active", Type::Bit, box.variant == kOffDelay ? 1 : 0),
                         box.slots.make("since", Type::I64, -1)};
  const Place timer = box.memory.word(box.operands[0].address, Reach::User);
  ValueId valid = timer.valid;
  const ValueId presetMs = preset(box, valid);
  return guarded(box, valid, [&] { return step(box, timer, presetMs, state); });
}

// The limit of the set value depends on the basis.
void checkTimer(std::span<const Operand> operands, const Config&, Diagnostics& diagnostics) {
  const Operand& set = operands[1];
  const Operand& basis = operands[2];
  if (set.form != Form::Constant || basis.form != Form::Constant) return;
  const int64_t limit = kLimit[basis.constant.integer];
  if (set.constant.integer > limit)
    diagnostics.report(Diag::ConstantOutOfRange, set.source->range)
        << set.source->text << "0 to " + std::to_string(limit);
}

} // namespace rung::nct
