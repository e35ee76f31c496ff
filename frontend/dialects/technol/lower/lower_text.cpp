// MV, CLEAR and texts (man. ch. 3.15, 3.18).
#include "frontend/dialects/technol/lower/lower_text.h"

#include <algorithm>

#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lowering.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

// One side of a comparison; bytes beyond `room` count as 0.
struct Side {
  Area area;
  ValueId room;
};

ValueId byteOf(ir::RungBuilder& b, const Side& side, ValueId i) {
  const ValueId zero = b.constant(Type::I8, 0);
  if (side.area.bytes == 0) return zero;
  const ValueId inside = b.ltU(i, side.room);
  return b.select(inside, loadByte(b, side.area, b.select(inside, i, b.i32(0))), zero);
}

// Compares two areas byte by byte. With `texts`, a common 0 ends the comparison.
void compare(Emitter& emitter, const Side& left, const Side& right, const Length& count, bool texts) {
  ir::RungBuilder& b = emitter.b();
  if (count.most == 0) return emitter.r().setRlo(b.bit(true));
  const auto pass = [&](ValueId i, ValueId equalSoFar, ValueId goesOn) {
    const ValueId x = byteOf(b, left, i), y = byteOf(b, right, i);
    const ValueId counts = b.and_(goesOn, b.ltU(i, count.value));
    const ValueId equal = b.and_(equalSoFar, b.or_(b.not_(counts), b.eq(x, y)));
    const ValueId goes = b.and_(counts, equal);
    return std::array{equal, texts ? b.and_(goes, b.ne(x, b.constant(Type::I8, 0))) : goes};
  };
  emitter.r().setRlo(passWhile(b, count.most, b.bit(true), pass));
}

// Copies the bytes that exist and clears the rest of the target.
void copyInside(Emitter& emitter, const Area& to, const Area& from, const Length& count) {
  ir::RungBuilder& b = emitter.b();
  const Length exist = inside(emitter, from, count);
  copy(emitter, to, from, exist);
  if (exist.most < count.most) clear(b, shifted(b, to, exist.value), fixedCount(b, count.most - exist.most));
}

} // namespace

// The source is the first operand (man. l.1484, l.13540; one example has the opposite order).
void lowerMoveMemory(Lowering& l, std::span<const Operand> o, int) {
  const bool isLong = !o[2].isConstant() || o[2].value > kManyPasses;
  inOwnRung(l.emitter.out(), isLong, [&] {
    const Length count = countOf(l.memory, o[2]);
    const Area from = areaOf(l.memory, o[0]), to = areaOf(l.memory, o[1]);
    copyInside(l.emitter, to, from, inside(l.emitter, to, count));
  });
}

// Clears from the first address up to the second, which is excluded.
void lowerClear(Lowering& l, std::span<const Operand> o, int) {
  if (o[0].form == Operand::Form::Keyword) return l.clears.call(o[0].value == 0);
  l.emitter.out().cut();
  const Area begin = areaOf(l.memory, o[0]), end = areaOf(l.memory, o[1]);
  ir::RungBuilder& b = l.b();
  if (begin.fixed && end.fixed) {
    clearRange(l.memory, begin.space, begin.first, end.first);
  } else {
    l.emitter.protect(b.ltU(end.at, begin.at));
    clear(b, begin, {.fixed = false, .most = begin.bytes, .value = b.sub(end.at, begin.at)});
  }
  l.emitter.out().cut();
}

// Copies until the terminator (inclusive), the end of the target, or `num` characters (man. l.1720-1744). A source
// without a terminator has as many characters as it holds.
void lowerCopyText(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l.emitter.out(), anyIsLong(o), [&] {
    const Text to = textOf(l.memory, o[0]), from = textOf(l.memory, o[1]);
    ir::RungBuilder& b = l.b();
    const Length length = lengthOf(b, from);
    Length copied = smaller(b, length, roomOf(to));
    ValueId ends = b.leU(length.value, to.room);
    if (o[2].given()) {
      const Length limit = countOf(l.memory, o[2]);
      ends = b.and_(ends, b.ltU(length.value, limit.value));
      copied = smaller(b, copied, limit);
    }
    copy(l.emitter, to.area, from.area, copied);
    storeTerminator(b, to.area, length.value, ends);
  });
}

// The joined text is cut off at the end of the target (man. l.1746).
void lowerAddText(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l.emitter.out(), anyIsLong(o), [&] {
    const Text to = textOf(l.memory, o[0]), from = textOf(l.memory, o[1]);
    ir::RungBuilder& b = l.b();
    const Length used = lengthOf(b, to), length = lengthOf(b, from);
    const Length room{.fixed = false, .most = to.most, .value = b.sub(to.room, used.value)};
    const Length added = smaller(b, length, room);
    copy(l.emitter, shifted(b, to.area, used.value), from.area, added);
    storeTerminator(b, to.area, b.add(used.value, added.value), b.ne(added.value, b.i32(0)));
  });
}

// Writes the last digits of the number, as many as the text has characters (man. l.1826).
void lowerNumberToText(Lowering& l, std::span<const Operand> o, int bcd) {
  const Text text = textOf(l.memory, o[0]);
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

// Compares until a difference, a common terminator or `num` characters; the second text includes its terminator (man.
// l.1860-1870).
void lowerCompareText(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l.emitter.out(), anyIsLong(o), [&] {
    const Text left = textOf(l.memory, o[0]), right = textOf(l.memory, o[1]);
    const Length whole = fixedCount(l.b(), right.most + 1);
    const Length count = o[2].given() ? smaller(l.b(), whole, countOf(l.memory, o[2])) : whole;
    compare(l.emitter, {left.area, left.room}, {right.area, right.room}, count, true);
  });
}

// Terminators count as ordinary bytes; if `num` is omitted, copying ends when the target is full (man. l.1911-1925).
void lowerCopyBytes(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l.emitter.out(), anyIsLong(o), [&] {
    const Text to = textOf(l.memory, o[0]), from = textOf(l.memory, o[1]);
    const Length count = o[2].given() ? smaller(l.b(), roomOf(to), countOf(l.memory, o[2])) : roomOf(to);
    copyInside(l.emitter, to.area, from.area, count);
  });
}

// If `num` is omitted, compares as many bytes as the second text holds (man. l.1943-1953).
void lowerCompareBytes(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l.emitter.out(), anyIsLong(o), [&] {
    const Text left = textOf(l.memory, o[0]), right = textOf(l.memory, o[1]);
    const Length count = o[2].given() ? countOf(l.memory, o[2]) : roomOf(right);
    const Length there = inside(l.emitter, left.area, count), here = inside(l.emitter, right.area, count);
    compare(l.emitter, {left.area, there.value}, {right.area, here.value}, count, false);
  });
}

// Texts.

using ir::Type;
using ir::ValueId;

Text textOf(Memory& memory, const Operand& operand) {
  Emitter& emitter = memory.emitter();
  ir::RungBuilder& b = emitter.b();
  Text text;
  if (operand.form == Operand::Form::Text) {
    text.literal = true;
    text.most = static_cast<uint32_t>(operand.text.size());
    text.room = b.i32(text.most);
    text.area = text.most == 0 ? Area{.space = {}, .bytes = 0, .fixed = true, .first = 0, .at = b.i32(0)}
                               : fixedArea(emitter, emitter.constantBytes(operand.text), text.most, 0);
    return text;
  }
  text.area = areaOf(memory, operand);
  if (!operand.indexed) {
    text.most = operand.size() - 1;
    text.room = b.i32(text.most);
    return text;
  }
  text.most = static_cast<uint32_t>(operand.end - 1 - operand.begin);
  const ValueId at = b.sub(text.area.at, memory.placeIn(operand, operand.begin));
  emitter.protect(b.ltU(b.i32(text.most), at));
  text.room = b.sub(b.i32(text.most), at);
  return text;
}

Length lengthOf(ir::RungBuilder& b, const Text& text) {
  if (text.literal || text.most == 0) return fixedCount(b, text.most);
  const auto count = [&](ValueId i, ValueId length, ValueId goesOn) {
    const ValueId inside = b.and_(goesOn, b.ltU(i, text.room));
    const ValueId at = b.select(inside, i, b.i32(0));
    const ValueId goes = b.and_(inside, b.ne(loadByte(b, text.area, at), b.constant(Type::I8, 0)));
    return std::array{b.select(goes, b.add(i, b.i32(1)), length), goes};
  };
  return {.fixed = false, .most = text.most, .value = passWhile(b, text.most, b.i32(0), count)};
}

void storeTerminator(ir::RungBuilder& b, const Area& area, ValueId at, ValueId cond) {
  b.when(cond, [&] { storeByte(b, area, at, b.constant(Type::I8, 0)); });
}

bool anyIsLong(std::span<const Operand> operands) {
  return std::any_of(operands.begin(), operands.end(), [](const Operand& operand) {
    const bool isText = operand.form == Operand::Form::Cell && operand.type == Type::None;
    return isText && operand.end - operand.begin > kManyPasses;
  });
}

} // namespace rung::frontend::technol
