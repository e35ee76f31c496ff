// ROT, the shift register and the array instructions (man. §6.6, §6.7).
#include "frontend/dialects/nct/lower/lower.h"
#include "ir/core/ops.h"

namespace rung::frontend::nct {

using ir::OpCode;
using ir::RungBuilder;
using ir::SlotId;
using ir::Type;
using ir::ValueId;

namespace {

enum RotationPins : size_t { kEnablePin, kShorter, kDirection, kSteps, kBefore };

struct Ring {
  ValueId current, goal, start, end;
};

struct Path {
  ValueId toGo;
  ValueId negative;
};

// The four positions are at least 0 and in range, so no difference overflows; only their number can reach 2^31.
Path findPath(Lowering& box, const Ring& ring) {
  RungBuilder& b = box.b;
  const ValueId one = b.i32(1), zero = b.i32(0);
  const ValueId positions = b.add(b.sub(ring.end, ring.start), one);
  const ValueId ahead = b.leS(ring.current, ring.goal);
  const ValueId distance = b.select(ahead, b.sub(ring.goal, ring.current), b.sub(ring.current, ring.goal));
  const ValueId there = b.eq(distance, zero);
  const ValueId otherWay = b.select(there, zero, b.sub(positions, distance));
  const ValueId up = b.select(ahead, distance, otherWay);
  const ValueId down = b.select(ahead, otherWay, distance);
  const ValueId negative = b.select(box.power(kShorter), b.ltU(down, up), box.power(kDirection)); // a tie is positive
  const ValueId steps = b.select(negative, down, up);
  const ValueId before = b.and_(box.power(kBefore), b.not_(there));
  const ValueId above = b.select(b.eq(ring.goal, ring.end), ring.start, b.add(ring.goal, one));
  const ValueId below = b.select(b.eq(ring.goal, ring.start), ring.end, b.sub(ring.goal, one));
  const ValueId position = b.select(before, b.select(negative, above, below), ring.goal);
  const ValueId count = b.select(before, b.sub(steps, one), steps);
  return {b.select(box.power(kSteps), count, position), negative};
}

} // namespace

// Calculates on the rising edge; the output keeps the last direction (l.1675), even if a value was out of range.
ValueId lowerRotation(Lowering& box) {
  RungBuilder& b = box.b;
  Memory& memory = box.memory;
  const ValueId edge = risingEdge(box, "edge", 0);
  const SlotId output = box.slots.make("direction", Type::Bit);
  const Place target = memory.word(box.operands[0].address, AccessBound::Write);
  ValueId valid = target.valid;
  Ring ring;
  ring.current = memory.integer(box.operands[1], valid);
  ring.goal = memory.integer(box.operands[2], valid);
  ring.start = memory.integer(box.operands[3], valid);
  ring.end = memory.integer(box.operands[4], valid);
  valid = memory.both(valid, b.leS(b.i32(0), ring.start));
  for (ValueId position : {ring.current, ring.goal})
    valid = memory.both(valid, b.and_(b.leS(ring.start, position), b.leS(position, ring.end)));
  b.when(edge, [&] {
    guarded(box, valid, [&] {
      const Path path = findPath(box, ring);
      memory.storeWord(target, path.toGo);
      b.slotStore(output, path.negative);
      memory.setErrorFlag(false);
      return ValueId{};
    });
  });
  return b.slotLoad(output);
}

// Left: the new bit enters at bit 0 and bit 31 leaves; right: the other way round. The output keeps the bit that left.
ValueId lowerShiftRegister(Lowering& box) {
  RungBuilder& b = box.b;
  const ValueId edge = risingEdge(box, "edge", 0);
  const SlotId output = box.slots.make("out", Type::Bit);
  const Place place = box.memory.word(box.operands[0].address, AccessBound::Write);
  b.when(edge, [&] {
    guarded(box, place.valid, [&] {
      const ValueId word = box.memory.loadWord(place);
      const ValueId one = b.i32(1), top = b.i32(31);
      const ValueId in = b.zextOrTrunc(Type::I32, box.power(2));
      const ValueId left = b.or_(b.shl(word, one), in);
      const ValueId right = b.or_(b.shrU(word, one), b.shl(in, top));
      const ValueId toRight = box.power(1);
      const ValueId highest = b.zextOrTrunc(Type::Bit, b.shrU(word, top));
      b.slotStore(output, b.select(toRight, b.zextOrTrunc(Type::Bit, word), highest));
      box.memory.storeWord(place, b.select(toRight, right, left));
      box.memory.setErrorFlag(false);
      return ValueId{};
    });
  });
  return b.slotLoad(output);
}

namespace {

// Word i of the shifted or rotated bit string, computed from two source words. A shift reads 0 outside the array.
ValueId shiftedWord(Lowering& box, const WordRange& array, ValueId i, ValueId words, ValueId bits) {
  RungBuilder& b = box.b;
  const bool left = box.variant == kShiftLeft || box.variant == kRotateLeft;
  const bool rotate = box.variant == kRotateLeft || box.variant == kRotateRight;
  const ValueId one = b.i32(1);
  const auto fetch = [&](ValueId index) {
    if (rotate) {
      // `index` is at most one array length out of range.
      const ValueId wrapped = left ? b.select(b.ltS(index, b.i32(0)), b.add(index, array.length), index)
                                   : b.select(b.leS(array.length, index), b.sub(index, array.length), index);
      return box.memory.loadIn(array, wrapped);
    }
    return b.select(b.ltU(index, array.length), box.memory.loadIn(array, index), b.i32(0));
  };
  const ValueId near = left ? b.sub(i, words) : b.add(i, words);
  const ValueId far = left ? b.sub(near, one) : b.add(near, one);
  const ValueId rest = b.sub(b.i32(32), bits); // 32 shifts everything out
  const OpCode toward = left ? OpCode::Shl : OpCode::ShrU;
  const OpCode away = left ? OpCode::ShrU : OpCode::Shl;
  const ValueId low = b.op(toward, Type::I32, {fetch(near), bits});
  return b.or_(low, b.op(away, Type::I32, {fetch(far), rest}));
}

} // namespace

// The result is assembled in scratch memory and copied back, so no word is read after it was written. With fixed
// addresses the loops are as long as the array, otherwise as long as the memory.
ValueId lowerArray(Lowering& box) {
  RungBuilder& b = box.b;
  Memory& memory = box.memory;
  return execute(box, [&] {
    const Place from = memory.word(box.operands[0].address, AccessBound::Write);
    const Place to = memory.word(box.operands[1].address, AccessBound::Write);
    ValueId valid = memory.both(from.valid, to.valid);
    const ValueId count = memory.integer(box.operands[2], valid);
    if (box.operands[2].form != Form::Constant) valid = memory.both(valid, b.not_(b.ltS(count, b.i32(0))));
    const WordRange array = memory.range(from, to);
    // The ends must be in order: at least one word.
    if (array.first.valid()) valid = memory.both(valid, b.ltS(b.i32(0), array.length));
    const bool fixed = !array.first.valid();
    return guarded(box, valid, [&] {
      ValueId amount = count;
      if (box.variant == kRotateLeft || box.variant == kRotateRight)
        amount = b.remU(count, b.mul(array.length, b.i32(32)));
      const ValueId words = b.shrU(amount, b.i32(5));
      const ValueId bits = b.and_(amount, b.i32(31));
      const auto eachWord = [&](auto act) {
        const ValueId i = b.loop(array.mostWords).front();
        b.when(fixed ? ValueId{} : b.ltU(i, array.length), [&] { act(i); });
        b.endLoop();
      };
      eachWord([&](ValueId i) { memory.storeScratch(i, shiftedWord(box, array, i, words, bits)); });
      eachWord([&](ValueId i) { memory.storeIn(array, i, memory.loadScratch(i)); });
      memory.setErrorFlag(false);
      return ValueId{};
    });
  });
}

} // namespace rung::frontend::nct
