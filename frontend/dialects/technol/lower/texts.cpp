// Texts (see texts.h).
#include "frontend/dialects/technol/lower/texts.h"

#include <algorithm>

namespace rung::frontend::technol {

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
