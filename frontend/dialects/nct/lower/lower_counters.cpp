// CNT and CNTR (man. §6.5).
#include "frontend/dialects/nct/lower/lower.h"

namespace rung::frontend::nct {

using ir::RungBuilder;
using ir::ValueId;

namespace {

enum Pins : size_t { kClock, kDown, kClear };

// An operand of 0 to 2147483647.
ValueId count(Lowering& box, size_t i, ValueId& valid) {
  const ValueId value = box.memory.integer(box.operands[i], valid);
  if (box.operands[i].form == Form::Constant) return value;
  const ValueId negative = box.b.ltS(value, box.b.i32(0));
  valid = box.memory.both(valid, box.b.not_(negative));
  return value;
}

// CNT stops at the end value until it is reset (l.1509); CNTR goes round from one end to the other (l.1545-1549). A
// counter keeps its direction, so there are branches.
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

// The reset goes before the clock; the clock's edge is remembered whatever else happens. Most scans have neither, and
// leave the counter alone.
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
