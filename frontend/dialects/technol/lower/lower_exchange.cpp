// Mapped and logical inputs and outputs (man. ch. 10, 27): the declared variable takes its default value, and the
// control learns of it.
#include <array>
#include <bit>

#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lower_identifier.h"
#include "frontend/dialects/technol/lower/lowering.h"
#include "rtlib/nc/technol/exchange.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;
using nc::ExchangeKind;
using nc::ExchangePeriod;
using nc::ExchangeType;

namespace {

ValueId defaultOf(ir::RungBuilder& b, const Operand& given, Type type) {
  if (type == Type::F64)
    return b.real(given.form == Operand::Form::Real ? given.real : static_cast<double>(given.value));
  return b.constant(type, given.value);
}

ValueId fromBits(ir::RungBuilder& b, ValueId word, Type type) {
  if (type == Type::F64) return b.bitsToF(word);
  if (type == Type::Bit) return b.ne(word, b.constant(Type::I64, 0));
  return b.zextOrTrunc(type, word);
}

// All elements become `value`.
void fill(ir::RungBuilder& b, const Operand& target, uint32_t count, ValueId value) {
  if (count == 1) return b.store(target.place, value);
  const bool bits = target.type == Type::Bit;
  const uint32_t bytes = bits ? 1 : ir::byteWidth(target.type);
  const ir::Window window{.space = target.place.space, .byte = target.place.byte, .count = (count - 1) * bytes + 1};
  const ValueId index = b.mul(b.loop(count)[0], b.i32(bytes));
  if (bits)
    b.storeBitAt(window, index, b.i32(0), value);
  else
    b.storeAt(window, index, value);
  b.endLoop();
}

void fillText(ir::RungBuilder& b, const Operand& target, const Operand& given) {
  ir::Place at = target.place;
  for (const char c : given.text.substr(0, target.size() - 1)) {
    b.store(at, b.constant(Type::I8, static_cast<uint8_t>(c)));
    ++at.byte;
  }
  b.store(at, b.constant(Type::I8, 0));
}

ExchangePeriod periodOf(ExchangeKind kind, const Operand& given) {
  if (!given.given()) return ExchangePeriod::Slow;
  return nc::isMapped(kind) ? ExchangePeriod::Fast : static_cast<ExchangePeriod>(given.value);
}

// A value of the configuration goes before the instruction's own; without both the variable stays.
void setDefault(ir::RungBuilder& b, const Exchanged& variable, const Operand& target, const Operand& given,
                ValueId ticket) {
  if (variable.type == ExchangeType::Text && given.given()) return fillText(b, target, given);
  if (nc::isText(variable.type)) return;
  const ValueId found = answersYes(b, ticket, 1);
  const ValueId configured = fromBits(b, b.serviceResult(ticket, 2), target.type);
  if (given.given())
    return fill(b, target, variable.count, b.select(found, configured, defaultOf(b, given, target.type)));
  b.when(found, [&] { fill(b, target, variable.count, configured); });
}

} // namespace

// MAP_xx variable, identifier [, default [, FAST]] and DEF_xx variable, identifier, type [, default [, period]].
void lowerDefine(Lowering& l, std::span<const Operand> o, int) {
  const Exchanged& variable = l.program.declarations.exchanged[o[0].index];
  const bool mapped = nc::isMapped(variable.kind);
  const Operand& given = o[mapped ? 2 : 3];
  const ExchangePeriod period = periodOf(variable.kind, o[mapped ? 3 : 4]);
  ir::RungBuilder& b = l.b();
  const auto word = [&](int64_t value) { return b.constant(Type::I64, value); };
  const ir::Place at = o[0].place;
  const ValueId head[] = {word(nc::exchangeArgument(variable.kind, variable.type, period, variable.count)),
                          l.emitter.address(Type::I64, nc::placeArgument(at.space.index, at.byte, at.bit), at),
                          word(nc::kNoPlace), word(nc::kNoPlace)};
  setDefault(b, variable, o[0], given, defineRequest(l.memory, head, o[1]));
}

namespace {

// One element, which begins `offset` bytes after the variable's place.
void takeElement(Emitter& emitter, const Operand& target, uint32_t offset) {
  ir::RungBuilder& b = emitter.b();
  ir::Place at = target.place;
  at.byte += offset;
  const ValueId place = emitter.address(Type::I64, nc::placeArgument(at.space.index, at.byte, at.bit), at);
  const ValueId ticket = b.serviceRequest(emitter.service(nc::technol::ServiceKind::UpdateInput), std::array{place});
  b.when(answersYes(b, ticket, 0), [&] { b.store(at, fromBits(b, b.serviceResult(ticket, 1), target.type)); });
}

} // namespace

// UPDATE_IN input or input[i]: also the outputs of this program that are connected to it, as they are now.
void lowerUpdate(Lowering& l, std::span<const Operand> o, int) {
  const Exchanged& variable = l.program.declarations.exchanged[o[0].index];
  const uint32_t bytes = nc::bytesOf(variable.type);
  const auto first = static_cast<uint32_t>(std::max<int64_t>(o[0].value, 0));
  const uint32_t end = o[0].value < 0 ? variable.count : first + 1;
  for (uint32_t i = first; i < end; ++i) takeElement(l.emitter, o[0], i * bytes);
}

} // namespace rung::frontend::technol
