// Configuration and constants of the machine (man. ch. 16).
#include <algorithm>
#include <array>

#include "frontend/dialects/technol/lower/device_request.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lower_exchange.h"
#include "frontend/dialects/technol/lower/lower_text.h"
#include "frontend/dialects/technol/lower/lowering.h"

#include "rtlib/nc/technol/services.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;
using Kind = nc::ConfigurationKind;

namespace {

constexpr uint32_t kHead = nc::kConfigurationHead;
constexpr uint32_t kWords = nc::kConfigurationWords;
constexpr uint32_t kBytes = nc::kConfigurationBytes;

// The identifier, eight characters per word.
using Words = std::vector<ValueId>;

ValueId request(Emitter& emitter, Kind kind, ValueId part, const Words& id) {
  ir::RungBuilder& b = emitter.b();
  std::array<ValueId, kHead + kWords> args;
  args[0] = b.constant(Type::I64, static_cast<int64_t>(kind));
  args[1] = part;
  std::copy(id.begin(), id.end(), args.begin() + kHead);
  return b.serviceRequest(emitter.service(nc::technol::ServiceKind::Configuration), args);
}

// ---- numbers and bits -----------------------------------------------------------------------------------------------

ValueId asReal(ir::RungBuilder& b, const Operand& operand, ValueId value) {
  if (operand.form == Operand::Form::Integer) return b.real(static_cast<double>(operand.value));
  return operand.negated ? b.fNeg(value) : value;
}

ValueId defaultOf(Memory& memory, Kind kind, const Operand& operand, Type type) {
  ir::RungBuilder& b = memory.emitter().b();
  switch (kind) {
  case Kind::Real: return asReal(b, operand, memory.value(operand));
  case Kind::Bit: return operand.isConstant() ? b.bit(operand.value != 0) : memory.bit(operand);
  case Kind::Integer:
  case Kind::Constant:
  case Kind::Text:
  case Kind::Binary: return b.sextOrTrunc(type, memory.value(operand));
  }
  return {};
}

ValueId resultOf(ir::RungBuilder& b, Kind kind, ValueId ticket, Type type) {
  const ValueId word = b.serviceResult(ticket, kHead);
  if (kind == Kind::Real) return b.bitsToF(word);
  return b.zextOrTrunc(type, word);
}

void getValue(Lowering& l, std::span<const Operand> o, Kind kind) {
  ir::RungBuilder& b = l.b();
  const MemoryAccess target = l.memory.reach(o[0]);
  const Words id = identifierWords(l.memory, o[1], kWords);
  const bool hasDefault = o.size() > 2 && o[2].given();
  const ValueId otherwise = hasDefault ? defaultOf(l.memory, kind, o[2], o[0].type) : ValueId{};
  const ValueId ticket = request(l.emitter, kind, b.constant(Type::I64, 0), id);
  const ValueId found = answersYes(b, ticket, 0);
  const ValueId value = resultOf(b, kind, ticket, o[0].type);
  l.r().setRlo(found);
  if (kind == Kind::Constant)
    l.r().setDr(b.select(found, b.zextOrTrunc(Type::I32, b.serviceResult(ticket, kHead)), b.i32(0)));
  if (hasDefault) return l.memory.store(target, b.select(found, value, otherwise));
  b.when(found, [&] { l.memory.store(target, value); });
}

// ---- texts ----------------------------------------------------------------------------------------------------------

// Stores a text, cut off at the end of the target.
void putText(Emitter& emitter, const Text& target, Kind kind, const Words& id, ValueId found) {
  ir::RungBuilder& b = emitter.b();
  const Length length{.fixed = false, .most = UINT32_MAX, .value = found};
  const ValueId count = smaller(b, length, roomOf(target)).value;
  putParts(b, target.area, count, target.most, {.bytes = kBytes, .firstWord = kHead},
           [&](ValueId part) { return request(emitter, kind, b.zextOrTrunc(Type::I64, part), id); });
  if (kind != Kind::Binary) storeTerminator(b, target.area, count, b.bit(true));
}

void putDefault(Emitter& emitter, const Text& target, const Text& source) {
  ir::RungBuilder& b = emitter.b();
  const Length count = smaller(b, lengthOf(b, source), roomOf(target));
  copy(emitter, target.area, source.area, count);
  storeTerminator(b, target.area, count.value, b.bit(true));
}

void getText(Lowering& l, std::span<const Operand> o, Kind kind) {
  const Text target = textOf(l.memory, o[0]);
  const Words id = identifierWords(l.memory, o[1], kWords);
  const Text source = o[2].given() ? textOf(l.memory, o[2]) : Text{};
  ir::RungBuilder& b = l.b();
  const ValueId ticket = request(l.emitter, kind, b.constant(Type::I64, 0), id);
  const ValueId found = answersYes(b, ticket, 0);
  const ValueId length = b.zextOrTrunc(Type::I32, b.serviceResult(ticket, 1));
  l.r().setRlo(found);
  const auto put = [&] { putText(l.emitter, target, kind, id, length); };
  if (!o[2].given()) return b.when(found, put);
  b.when(found, put, [&] { putDefault(l.emitter, target, source); });
}

} // namespace

// CNF_GET_xx target, identifier [, default] and CONST_GET cell, identifier: RLO says whether it was found.
void lowerConfiguration(Lowering& l, std::span<const Operand> o, int kind) {
  const auto wanted = static_cast<Kind>(kind);
  if (wanted != Kind::Text && wanted != Kind::Binary) return getValue(l, o, wanted);
  inOwnRung(l.emitter.out(), anyIsLong(o), [&] { getText(l, o, wanted); });
}

} // namespace rung::frontend::technol
