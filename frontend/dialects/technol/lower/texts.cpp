// Texts (see texts.h).
#include "frontend/dialects/technol/lower/texts.h"

#include <algorithm>

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

Text textOf(Memory& m, const Operand& operand) {
  ir::RungBuilder& b = m.b();
  Text text;
  if (operand.form == Operand::Form::Text) {
    text.literal = true;
    text.most = static_cast<uint32_t>(operand.text.size());
    text.room = b.i32(text.most);
    text.area = text.most == 0 ? Area{.space = {}, .bytes = 0, .fixed = true, .first = 0, .at = b.i32(0)}
                               : fixedArea(m, m.constantBytes(operand.text), text.most, 0);
    return text;
  }
  text.area = areaOf(m, operand);
  if (!operand.indexed) {
    text.most = operand.size - 1;
    text.room = b.i32(text.most);
    return text;
  }
  text.most = static_cast<uint32_t>(operand.end - 1 - operand.begin);
  const ValueId at = b.sub(text.area.at, b.i32(operand.begin));
  m.protect(b.ltU(b.i32(text.most), at));
  text.room = b.sub(b.i32(text.most), at);
  return text;
}

namespace {

// Passes from `start` on that count characters until the terminator or `room`. `state`: characters so far, whether it
// goes on.
std::vector<ValueId> countPasses(Memory& m, const Text& text, uint32_t passes, ValueId start,
                                 std::span<const ValueId> state) {
  ir::RungBuilder& b = m.b();
  const auto pass = b.loop(passes, state);
  const ValueId i = b.add(start, pass[0]);
  const ValueId inside = b.and_(pass[2], b.ltU(i, text.room));
  const ValueId at = b.select(inside, i, b.i32(0));
  const ValueId goes = b.and_(inside, b.ne(loadByte(m, text.area, at), b.constant(Type::I8, 0)));
  const ValueId next[] = {b.select(goes, b.add(i, b.i32(1)), pass[1]), goes};
  return b.endLoop(next);
}

} // namespace

// Blocks after the end are passed over.
Length lengthOf(Memory& m, const Text& text) {
  ir::RungBuilder& b = m.b();
  if (text.literal || text.most == 0) return fixedCount(m, text.most);
  const ValueId none[] = {b.i32(0), b.bit(true)};
  const auto length = [&](ValueId value) { return Length{.fixed = false, .most = text.most, .value = value}; };
  if (text.most <= 2 * kBlock) return length(countPasses(m, text, text.most, b.i32(0), none)[0]);
  const auto block = b.loop((text.most + kBlock - 1) / kBlock, none);
  const ValueId state[] = {block[1], block[2]};
  b.if_(block[2]);
  const auto counted = countPasses(m, text, kBlock, b.mul(block[0], b.i32(kBlock)), state);
  b.else_(counted);
  return length(b.endLoop(b.endIf(state))[0]);
}

void storeTerminator(Memory& m, const Area& area, ValueId at, ValueId cond) {
  m.b().if_(cond);
  storeByte(m, area, at, m.b().constant(Type::I8, 0));
  m.b().endIf();
}

bool anyIsLong(std::span<const Operand> operands) {
  return std::any_of(operands.begin(), operands.end(), [](const Operand& operand) {
    const bool isText = operand.form == Operand::Form::Cell && operand.type == Type::None;
    return isText && operand.end - operand.begin > kManyPasses;
  });
}

} // namespace rung::frontend::technol
