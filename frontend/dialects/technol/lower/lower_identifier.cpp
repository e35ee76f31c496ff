// Identifiers as words (see lower_identifier.h).
#include "frontend/dialects/technol/lower/lower_identifier.h"

#include <algorithm>
#include <array>

#include "frontend/dialects/technol/lower/texts.h"
#include "frontend/lower/request.h"
#include "rtlib/nc/technol/exchange.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

ValueId quotedWord(ir::RungBuilder& b, std::string_view text) {
  uint64_t bits = 0;
  for (size_t i = 0; i < 8 && i < text.size(); ++i) bits |= uint64_t{static_cast<uint8_t>(text[i])} << i * 8;
  return b.constant(Type::I64, static_cast<int64_t>(bits));
}

// Characters `first` to `first` + `count`.
ValueId loadedWord(ir::RungBuilder& b, const Text& text, uint32_t first, uint32_t count) {
  const auto in = b.loop(count, std::array{b.constant(Type::I64, 0)});
  const ValueId number = b.add(in[0], b.i32(first));
  const auto join = [&] {
    const ValueId byte = b.zextOrTrunc(Type::I64, loadByte(b, text.area, number));
    return b.or_(in[1], b.shl(byte, b.mul(in[0], b.i32(8))));
  };
  return b.endLoop(std::array{b.choose(b.ltU(number, text.room), join, [&] { return in[1]; })})[0];
}

} // namespace

std::vector<ValueId> identifierWords(Memory& memory, const Operand& id, uint32_t words) {
  ir::RungBuilder& b = memory.emitter().b();
  std::vector<ValueId> made;
  const bool quoted = id.form == Operand::Form::Text;
  const Text text = quoted ? Text{} : textOf(memory, id);
  for (uint32_t first = 0; first < words * 8; first += 8) {
    if (quoted)
      made.push_back(quotedWord(b, id.text.substr(std::min<size_t>(first, id.text.size()))));
    else if (first < text.most)
      made.push_back(loadedWord(b, text, first, std::min(8u, text.most - first)));
    else
      made.push_back(b.constant(Type::I64, 0));
  }
  return made;
}

ValueId defineRequest(Memory& memory, std::span<const ValueId> head, const Operand& id) {
  std::vector<ValueId> args(head.begin(), head.end());
  const auto words = identifierWords(memory, id, nc::kDefineWords);
  args.insert(args.end(), words.begin(), words.end());
  return memory.emitter().b().serviceRequest(memory.emitter().service(nc::technol::ServiceKind::Define), args);
}

ValueId answersYes(ir::RungBuilder& b, ValueId ticket, uint32_t result) {
  return b.and_(isExecuted(b, ticket), b.ne(b.serviceResult(ticket, result), b.constant(Type::I64, 0)));
}

} // namespace rung::frontend::technol
