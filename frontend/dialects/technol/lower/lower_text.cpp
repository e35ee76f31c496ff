// MV, CLEAR and texts (man. ch. 3.15, 3.18).
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lowering.h"
#include "frontend/dialects/technol/lower/texts.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

// One side of a comparison; beyond `room` its bytes count as 0.
struct Side {
  Area area;
  ValueId room;
};

ValueId byteOf(Lowering& l, const Side& side, ValueId i) {
  ir::RungBuilder& b = l.b();
  const ValueId zero = b.constant(Type::I8, 0);
  if (side.area.bytes == 0) return zero;
  const ValueId inside = b.ltU(i, side.room);
  return b.select(inside, loadByte(l, side.area, b.select(inside, i, b.i32(0))), zero);
}

// Two areas compared byte by byte. A common 0 ends texts.
void compare(Lowering& l, const Side& left, const Side& right, const Length& count, bool texts) {
  ir::RungBuilder& b = l.b();
  if (count.most == 0) return l.r().setRlo(b.bit(true));
  const auto pass = [&](ValueId i, ValueId equalSoFar, ValueId goesOn) {
    const ValueId x = byteOf(l, left, i), y = byteOf(l, right, i);
    const ValueId counts = b.and_(goesOn, b.ltU(i, count.value));
    const ValueId equal = b.and_(equalSoFar, b.or_(b.not_(counts), b.eq(x, y)));
    const ValueId goes = b.and_(counts, equal);
    return std::array{equal, texts ? b.and_(goes, b.ne(x, b.constant(Type::I8, 0))) : goes};
  };
  l.r().setRlo(passWhile(l, count.most, b.bit(true), pass));
}

// Copies what is there and clears what is not.
void copyInside(Lowering& l, const Area& to, const Area& from, const Length& count) {
  const Length exist = inside(l, from, count);
  copy(l, to, from, exist);
  if (exist.most < count.most) clear(l, shifted(l, to, exist.value), fixedCount(l, count.most - exist.most));
}

} // namespace

// The source comes first (man. l.1484, l.13540; one example has it the other way round).
void lowerMoveMemory(Lowering& l, std::span<const Operand> o, int) {
  const bool isLong = !o[2].isConstant() || o[2].value > kManyPasses;
  inOwnRung(l, isLong, [&] {
    const Length count = countOf(l, o[2]);
    const Area from = areaOf(l, o[0]), to = areaOf(l, o[1]);
    copyInside(l, to, from, inside(l, to, count));
  });
}

// From the first address up to the second, which is not cleared.
void lowerClear(Lowering& l, std::span<const Operand> o, int) {
  if (o[0].form == Operand::Form::Keyword) return l.clears.call(o[0].value == 0);
  l.out().cut();
  const Area begin = areaOf(l, o[0]), end = areaOf(l, o[1]);
  ir::RungBuilder& b = l.b();
  if (begin.fixed && end.fixed) {
    clearRange(l, begin.space, begin.first, end.first);
  } else {
    l.protect(b.ltU(end.at, begin.at));
    clear(l, begin, {.fixed = false, .most = begin.bytes, .value = b.sub(end.at, begin.at)});
  }
  l.out().cut();
}

// Ends with the terminator, which is copied too, where the target is full, or after `num` characters (man.
// l.1720-1744). A source without a terminator has as many characters as it holds.
void lowerCopyText(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l, anyIsLong(o), [&] {
    const Text to = textOf(l, o[0]), from = textOf(l, o[1]);
    ir::RungBuilder& b = l.b();
    const Length length = lengthOf(l, from);
    Length copied = smaller(l, length, roomOf(to));
    ValueId ends = b.leU(length.value, to.room);
    if (o[2].given()) {
      const Length limit = countOf(l, o[2]);
      ends = b.and_(ends, b.ltU(length.value, limit.value));
      copied = smaller(l, copied, limit);
    }
    copy(l, to.area, from.area, copied);
    storeTerminator(l, to.area, length.value, ends);
  });
}

// The joined text is cut where the target is full (man. l.1746).
void lowerAddText(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l, anyIsLong(o), [&] {
    const Text to = textOf(l, o[0]), from = textOf(l, o[1]);
    ir::RungBuilder& b = l.b();
    const Length used = lengthOf(l, to), length = lengthOf(l, from);
    const Length room{.fixed = false, .most = to.most, .value = b.sub(to.room, used.value)};
    const Length added = smaller(l, length, room);
    copy(l, shifted(l, to.area, used.value), from.area, added);
    storeTerminator(l, to.area, b.add(used.value, added.value), b.ne(added.value, b.i32(0)));
  });
}

// As many digits as the text has characters, the last ones of the number (man. l.1826).
void lowerNumberToText(Lowering& l, std::span<const Operand> o, int bcd) {
  const Text text = textOf(l, o[0]);
  ir::RungBuilder& b = l.b();
  ValueId rest = b.zextOrTrunc(Type::I64, l.r().dr(o[1].given() ? Type::I32 : Type::I16));
  const ValueId base = b.constant(Type::I64, bcd ? 16 : 10);
  for (uint32_t i = text.most; i-- > 0;) {
    const ValueId digit = b.zextOrTrunc(Type::I8, b.remU(rest, base));
    b.store({.space = text.area.space, .byte = text.area.first + i}, b.add(digit, b.constant(Type::I8, '0')));
    rest = b.divU(rest, base);
  }
  b.store({.space = text.area.space, .byte = text.area.first + text.most}, b.constant(Type::I8, 0));
}

// Up to a difference, a common terminator or `num` characters; the second text with its terminator (man. l.1860-1870).
void lowerCompareText(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l, anyIsLong(o), [&] {
    const Text left = textOf(l, o[0]), right = textOf(l, o[1]);
    const Length whole = fixedCount(l, right.most + 1);
    const Length count = o[2].given() ? smaller(l, whole, countOf(l, o[2])) : whole;
    compare(l, {left.area, left.room}, {right.area, right.room}, count, true);
  });
}

// Terminators are bytes as any other; without `num` until the target is full (man. l.1911-1925).
void lowerCopyBytes(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l, anyIsLong(o), [&] {
    const Text to = textOf(l, o[0]), from = textOf(l, o[1]);
    const Length count = o[2].given() ? smaller(l, roomOf(to), countOf(l, o[2])) : roomOf(to);
    copyInside(l, to.area, from.area, count);
  });
}

// Without `num` as many bytes as the second text holds (man. l.1943-1953).
void lowerCompareBytes(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l, anyIsLong(o), [&] {
    const Text left = textOf(l, o[0]), right = textOf(l, o[1]);
    const Length count = o[2].given() ? countOf(l, o[2]) : roomOf(right);
    const Length there = inside(l, left.area, count), here = inside(l, right.area, count);
    compare(l, {left.area, there.value}, {right.area, here.value}, count, false);
  });
}

} // namespace rung::frontend::technol
