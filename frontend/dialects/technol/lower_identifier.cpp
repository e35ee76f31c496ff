// Identifiers as words (see lower_identifier.h).
#include "frontend/dialects/technol/lower_identifier.h"

#include <algorithm>
#include <array>

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

TextPlace placeOf(Lowering& l, const Operand& text) {
  ir::RungBuilder& b = l.b();
  const Access access = l.reach(text);
  if (!access.indexed)
    return {{.space = text.place.space, .byte = text.place.byte, .count = text.size}, b.i32(0), b.i32(text.size)};
  const ValueId bx = l.r().bx();
  const ValueId left = b.select(b.leS(b.i32(text.size), bx), b.i32(0), b.sub(b.i32(text.size), bx));
  return {access.window, access.index, b.select(b.ltS(bx, b.i32(0)), b.i32(text.size), left)};
}

ValueId byteAt(ir::RungBuilder& b, const TextPlace& text, ValueId number) {
  return b.loadAt(Type::I8, text.window, b.add(text.first, number));
}

namespace {

ValueId quotedWord(ir::RungBuilder& b, std::string_view text) {
  uint64_t bits = 0;
  for (size_t i = 0; i < 8 && i < text.size(); ++i) bits |= uint64_t{static_cast<uint8_t>(text[i])} << i * 8;
  return b.constant(Type::I64, static_cast<int64_t>(bits));
}

// Characters `first` to `first` + `count`.
ValueId loadedWord(ir::RungBuilder& b, const TextPlace& text, uint32_t first, uint32_t count) {
  const auto in = b.loop(count, std::array{b.constant(Type::I64, 0)});
  const ValueId number = b.add(in[0], b.i32(first));
  b.if_(b.ltU(number, text.room));
  const ValueId byte = b.zextOrTrunc(Type::I64, byteAt(b, text, number));
  const ValueId moved = b.op(ir::OpCode::Shl, Type::I64, {byte, b.mul(in[0], b.i32(8))});
  b.else_(std::array{b.or_(in[1], moved)});
  return b.endLoop(b.endIf(std::array{in[1]}))[0];
}

} // namespace

std::vector<ValueId> identifierWords(Lowering& l, const Operand& id, uint32_t words) {
  ir::RungBuilder& b = l.b();
  std::vector<ValueId> made;
  const bool quoted = id.form == Operand::Form::Text;
  const TextPlace text = quoted ? TextPlace{} : placeOf(l, id);
  for (uint32_t first = 0; first < words * 8; first += 8) {
    if (quoted)
      made.push_back(quotedWord(b, id.text.substr(std::min<size_t>(first, id.text.size()))));
    else if (first < id.size)
      made.push_back(loadedWord(b, text, first, std::min(8u, id.size - first)));
    else
      made.push_back(b.constant(Type::I64, 0));
  }
  return made;
}

} // namespace rung::frontend::technol
