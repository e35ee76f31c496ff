// CNT and CNTR (man. §6.5).
#include "frontend/dialects/nct/lower/lowering.h"

namespace rung::nct {

using ir::RungBuilder;
using ir::Type;
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

// CNT stops at the end value until it is reset (l.1509); CNTR goes round from one end to the other (l.1545-1549).
ValueId counted(Lowering& box, ValueId value, ValueId start, ValueId end) {
  RungBuilder& b = box.b;
  const ValueId down = box.power(kDown);
  const ValueId next = b.add(value, b.select(down, b.i32(-1), b.i32(1)));
  const ValueId atEnd = b.eq(value, end);
  if (box.variant == kStopping) return b.select(atEnd, value, next);
  const ValueId atStart = b.eq(value, start);
  const ValueId whenDown = b.select(atStart, end, next);
  return b.select(down, whenDown, b.select(atEnd, start, next));
}

} // namespace

// The reset goes before the clock; the clock's edge is remembered whatever else happens. Most scans have none: a region
// is shorter there than selects.
ValueId lowerCounter(Lowering& box) {
  RungBuilder& b = box.b;
  const ValueId edge = risingEdge(box, "clock", kClock);
  const Place counter = box.memory.word(box.operands[0].address, AccessBound::User);
  ValueId valid = counter.valid;
  const ValueId start = count(box, 1, valid);
  const ValueId end = count(box, 2, valid);
  const ValueId compare = count(box, 3, valid);
  if (box.variant == kRing) valid = box.memory.both(valid, b.leS(start, end));
  return guarded(box, valid, [&] {
    const ValueId value = box.memory.loadWord(counter);
    const ValueId stepped = b.choose(edge, [&] { return counted(box, value, start, end); }, [&] { return value; });
    const ValueId result = b.select(box.power(kClear), start, stepped);
    box.memory.storeWord(counter, result);
    return b.eq(result, compare);
  });
}

} // namespace rung::nct
