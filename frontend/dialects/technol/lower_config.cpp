// Configuration and constants of the machine (man. ch. 16).
#include <algorithm>
#include <array>

#include "frontend/dialects/technol/lower.h"
#include "frontend/dialects/technol/lower_identifier.h"

#include "rtlib/nc/technol/configuration.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;
using Kind = nc::ConfigurationKind;

ir::ServiceId Lowering::service(std::string_view signature) {
  const auto found = std::find(module_.services.begin(), module_.services.end(), signature);
  const auto index = static_cast<uint32_t>(found - module_.services.begin());
  if (found == module_.services.end()) module_.services.emplace_back(signature);
  return {index};
}

namespace {

constexpr uint32_t kHead = nc::kConfigurationHead;
constexpr uint32_t kWords = nc::kConfigurationWords;
constexpr uint32_t kBytes = nc::kConfigurationBytes;

// The identifier, eight characters a word.
using Words = std::vector<ValueId>;

Words identifier(Lowering& l, const Operand& id) { return identifierWords(l, id, kWords); }

ValueId request(Lowering& l, Kind kind, ValueId part, const Words& id) {
  std::array<ValueId, kHead + kWords> args;
  args[0] = l.b().constant(Type::I64, static_cast<int64_t>(kind));
  args[1] = part;
  std::copy(id.begin(), id.end(), args.begin() + kHead);
  return l.b().serviceRequest(l.service(nc::kConfigurationService), args);
}

// Not found where nobody answers.
ValueId foundBy(ir::RungBuilder& b, ValueId ticket) {
  const ValueId done = b.eq(b.servicePoll(ticket), b.i32(RUNG_SERVICE_DONE));
  return b.and_(done, b.ne(b.serviceResult(ticket, 0), b.constant(Type::I64, 0)));
}

// ---- numbers and bits -----------------------------------------------------------------------------------------------

ValueId asReal(ir::RungBuilder& b, const Operand& operand, ValueId value) {
  if (operand.form == Operand::Form::Integer) return b.real(static_cast<double>(operand.value));
  return operand.negated ? b.op(ir::OpCode::FNeg, Type::F64, {value}) : value;
}

ValueId defaultOf(Lowering& l, Kind kind, const Operand& operand, Type type) {
  ir::RungBuilder& b = l.b();
  switch (kind) {
  case Kind::Real: return asReal(b, operand, l.value(operand));
  case Kind::Bit: return operand.isConstant() ? b.bit(operand.value != 0) : l.bit(operand);
  case Kind::Integer:
  case Kind::Constant:
  case Kind::Text:
  case Kind::Binary: return b.sextOrTrunc(type, l.value(operand));
  }
  return {};
}

ValueId resultOf(ir::RungBuilder& b, Kind kind, ValueId ticket, Type type) {
  const ValueId word = b.serviceResult(ticket, kHead);
  if (kind == Kind::Real) return b.op(ir::OpCode::BitsToF, Type::F64, {word});
  return b.zextOrTrunc(type, word);
}

void getValue(Lowering& l, std::span<const Operand> o, Kind kind) {
  ir::RungBuilder& b = l.b();
  const Access target = l.reach(o[0]);
  const Words id = identifier(l, o[1]);
  const bool hasDefault = o.size() > 2 && o[2].given();
  const ValueId otherwise = hasDefault ? defaultOf(l, kind, o[2], o[0].type) : ValueId{};
  const ValueId ticket = request(l, kind, b.constant(Type::I64, 0), id);
  const ValueId found = foundBy(b, ticket);
  const ValueId value = resultOf(b, kind, ticket, o[0].type);
  l.r().setRlo(found);
  if (kind == Kind::Constant)
    l.r().setDr(b.select(found, b.zextOrTrunc(Type::I32, b.serviceResult(ticket, kHead)), b.i32(0)));
  if (hasDefault) return l.store(target, b.select(found, value, otherwise));
  b.if_(found);
  l.store(target, value);
  b.endIf();
}

// ---- texts ----------------------------------------------------------------------------------------------------------

void putByte(ir::RungBuilder& b, const TextPlace& target, ValueId number, ValueId byte) {
  b.storeAt(target.window, b.add(target.first, number), byte);
}

// The terminator behind `length` characters, as far as there is room.
void terminate(ir::RungBuilder& b, const TextPlace& target, ValueId length) {
  b.if_(b.ltU(length, target.room));
  putByte(b, target, length, b.constant(Type::I8, 0));
  b.endIf();
}

ValueId least(ir::RungBuilder& b, ValueId x, ValueId y) { return b.select(b.ltU(x, y), x, y); }

// How many characters the target holds: its last byte is the terminator's.
ValueId capacity(ir::RungBuilder& b, const TextPlace& target) {
  return b.select(b.eq(target.room, b.i32(0)), target.room, b.sub(target.room, b.i32(1)));
}

struct TextTarget {
  TextPlace place;
  uint32_t size;
  bool binary;
};

// Parts of the text, one request each.
void putParts(Lowering& l, const TextTarget& target, Kind kind, const Words& id, ValueId length) {
  ir::RungBuilder& b = l.b();
  const TextPlace& place = target.place;
  const ValueId count = least(b, length, capacity(b, place));
  const uint32_t parts = (target.size + kBytes - 1) / kBytes;
  const ValueId part = b.loop(parts)[0];
  const ValueId ticket = request(l, kind, b.zextOrTrunc(Type::I64, part), id);
  const uint32_t words = parts > 1 ? kWords : (target.size + 7) / 8;
  for (uint32_t w = 0; w < words; ++w) {
    const ValueId word = b.serviceResult(ticket, kHead + w);
    const ValueId first = b.add(b.mul(part, b.i32(kBytes)), b.i32(w * 8));
    const auto in = b.loop(8, std::array{word});
    const ValueId number = b.add(first, in[0]);
    b.if_(b.ltU(number, count));
    putByte(b, place, number, b.zextOrTrunc(Type::I8, in[1]));
    b.endIf();
    b.endLoop(std::array{b.op(ir::OpCode::ShrU, Type::I64, {in[1], b.i32(8)})});
  }
  b.endLoop();
  if (!target.binary) terminate(b, place, count);
}

void putQuoted(ir::RungBuilder& b, const TextTarget& target, std::string_view text) {
  const ValueId most = capacity(b, target.place);
  const auto length = std::min<uint32_t>(static_cast<uint32_t>(text.size()), target.size == 0 ? 0 : target.size - 1);
  for (uint32_t i = 0; i < length; ++i) {
    b.if_(b.ltU(b.i32(i), most));
    putByte(b, target.place, b.i32(i), b.constant(Type::I8, static_cast<uint8_t>(text[i])));
    b.endIf();
  }
  terminate(b, target.place, least(b, b.i32(length), most));
}

// Characters up to the terminator, or the end of either text.
void putCopied(ir::RungBuilder& b, const TextTarget& target, const TextPlace& source, uint32_t size) {
  const ValueId most = least(b, capacity(b, target.place), source.room);
  const auto in = b.loop(std::min(size, target.size), std::array{b.bit(true), b.i32(0)});
  const ValueId inside = b.and_(in[1], b.ltU(in[0], most));
  b.if_(inside);
  const ValueId byte = byteAt(b, source, in[0]);
  const ValueId counts = b.ne(byte, b.constant(Type::I8, 0));
  b.if_(counts);
  putByte(b, target.place, in[0], byte);
  b.endIf();
  b.else_(std::array{counts, b.add(in[2], b.zextOrTrunc(Type::I32, counts))});
  const auto after = b.endIf(std::array{b.bit(false), in[2]});
  terminate(b, target.place, b.endLoop(after)[1]);
}

void getText(Lowering& l, std::span<const Operand> o, Kind kind) {
  ir::RungBuilder& b = l.b();
  const TextTarget target{placeOf(l, o[0]), o[0].size, kind == Kind::Binary};
  const Words id = identifier(l, o[1]);
  const Operand& otherwise = o[2];
  TextPlace source;
  if (otherwise.form == Operand::Form::Cell) source = placeOf(l, otherwise);
  const ValueId ticket = request(l, kind, b.constant(Type::I64, 0), id);
  const ValueId found = foundBy(b, ticket);
  const ValueId length = b.zextOrTrunc(Type::I32, b.serviceResult(ticket, 1));
  l.r().setRlo(found);
  if (target.size == 0) return;
  b.if_(found);
  putParts(l, target, kind, id, length);
  if (otherwise.given()) {
    b.else_();
    if (otherwise.form == Operand::Form::Text)
      putQuoted(b, target, otherwise.text);
    else
      putCopied(b, target, source, otherwise.size);
  }
  b.endIf();
}

} // namespace

// CNF_GET_xx target, identifier [, default] and CONST_GET cell, identifier: RLO tells whether it was found.
void lowerConfiguration(Lowering& l, std::span<const Operand> o, int kind) {
  const auto wanted = static_cast<Kind>(kind);
  if (wanted == Kind::Text || wanted == Kind::Binary)
    getText(l, o, wanted);
  else
    getValue(l, o, wanted);
}

} // namespace rung::frontend::technol
