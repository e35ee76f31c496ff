// Mapped and logical inputs and outputs (man. ch. 10, 27): the declared variable gets its default value and is
// registered with the control.
#include "frontend/dialects/technol/lower/lower_exchange.h"

#include <algorithm>
#include <array>
#include <bit>

#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lower_text.h"
#include "frontend/dialects/technol/lower/lowering.h"
#include "frontend/lower/operations.h"
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

// Sets all elements to `value`.
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

// Sets the default. A value from the configuration has priority over the instruction's own; without both, the variable
// does not change.
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

// Updates one element, which begins `offset` bytes after the variable.
void takeElement(Emitter& emitter, const Operand& target, uint32_t offset) {
  ir::RungBuilder& b = emitter.b();
  ir::Place at = target.place;
  at.byte += offset;
  const ValueId place = emitter.address(Type::I64, nc::placeArgument(at.space.index, at.byte, at.bit), at);
  const ValueId ticket = b.serviceRequest(emitter.service(nc::technol::ServiceKind::UpdateInput), std::array{place});
  b.when(answersYes(b, ticket, 0), [&] { b.store(at, fromBits(b, b.serviceResult(ticket, 1), target.type)); });
}

} // namespace

// UPDATE_IN input or input[i]: also takes the current values of this program's outputs that are connected to it.
void lowerUpdate(Lowering& l, std::span<const Operand> o, int) {
  const Exchanged& variable = l.program.declarations.exchanged[o[0].index];
  const uint32_t bytes = nc::bytesOf(variable.type);
  const auto first = static_cast<uint32_t>(std::max<int64_t>(o[0].value, 0));
  const uint32_t end = o[0].value < 0 ? variable.count : first + 1;
  for (uint32_t i = first; i < end; ++i) takeElement(l.emitter, o[0], i * bytes);
}

// Variables that screens access by name (man. ch. 18.2).

using ir::Type;
using ir::ValueId;
using nc::ExchangeKind;
using nc::ExchangePeriod;
using nc::ExchangeType;

namespace {

// The place of an operand as an argument, with the current value of BX.
ValueId placeOf(Memory& memory, const Operand& operand, uint32_t bit) {
  const MemoryAccess access = memory.reach(operand);
  ir::RungBuilder& b = memory.emitter().b();
  const ir::Place at = operand.place;
  if (!access.indexed)
    return memory.emitter().address(Type::I64, nc::placeArgument(at.space.index, at.byte, bit),
                                    {at.space, at.byte, bit});
  const ValueId byte = b.zextOrTrunc(Type::I64, access.index);
  const ValueId shifted = b.shl(byte, b.i32(nc::kPlaceByteShift));
  return b.or_(shifted, b.constant(Type::I64, nc::placeArgument(at.space.index, 0, bit)));
}

ValueId limit(Memory& memory, const Operand& cell) {
  return cell.given() ? placeOf(memory, cell, 0) : memory.emitter().b().constant(Type::I64, nc::kNoPlace);
}

void share(Lowering& l, int64_t what, const Operand& id, std::array<ValueId, 3> places) {
  ir::RungBuilder& b = l.b();
  const ValueId head[] = {b.constant(Type::I64, what), places[0], places[1], places[2]};
  const ValueId ticket = defineRequest(l.memory, head, id);
  l.r().setRlo(answersYes(b, ticket, 0));
}

} // namespace

// SHARE_VAR variable, name, type [, least [, most]] or text, name, type [, length].
void lowerShareVariable(Lowering& l, std::span<const Operand> o, int) {
  const ExchangeType type = nc::exchangeTypeOf(o[2].value);
  const bool text = nc::isText(type);
  const uint32_t count = !text ? 1 : o[3].given() ? static_cast<uint32_t>(o[3].value) : o[0].size();
  const std::array<ValueId, 3> places = {placeOf(l.memory, o[0], 0), limit(l.memory, text ? Operand{} : o[3]),
                                         limit(l.memory, o[4])};
  share(l, nc::exchangeArgument(ExchangeKind::Variable, type, ExchangePeriod::Slow, count), o[1], places);
}

// SHARE_BIT byte, name, bit
void lowerShareBit(Lowering& l, std::span<const Operand> o, int) {
  const std::array<ValueId, 3> places = {placeOf(l.memory, o[0], o[2].place.bit), limit(l.memory, {}),
                                         limit(l.memory, {})};
  share(l, nc::exchangeArgument(ExchangeKind::Bit, ExchangeType::Bit, ExchangePeriod::Slow, 1), o[1], places);
}

// Identifiers as words of eight characters.

using ir::Type;
using ir::ValueId;

namespace {

ValueId quotedWord(ir::RungBuilder& b, std::string_view text) {
  uint64_t bits = 0;
  for (size_t i = 0; i < 8 && i < text.size(); ++i) bits |= uint64_t{static_cast<uint8_t>(text[i])} << i * 8;
  return b.constant(Type::I64, static_cast<int64_t>(bits));
}

// One word with the characters from `first` on, `count` of them.
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
