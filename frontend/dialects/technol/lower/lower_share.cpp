// Variables that screens see by a name (man. ch. 18.2).
#include <array>

#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lower_identifier.h"
#include "rtlib/nc/technol/exchange.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;
using nc::ExchangeKind;
using nc::ExchangePeriod;
using nc::ExchangeType;

namespace {

// Where an operand lies, as an argument; BX is taken now.
ValueId placeOf(Lowering& l, const Operand& operand, uint32_t bit) {
  const Access access = l.reach(operand);
  ir::RungBuilder& b = l.b();
  const ir::Place at = operand.place;
  if (!access.indexed) return b.constant(Type::I64, nc::placeArgument(at.space.index, at.byte, bit));
  const ValueId byte = b.zextOrTrunc(Type::I64, access.index);
  const ValueId shifted = b.op(ir::OpCode::Shl, Type::I64, {byte, b.i32(nc::kPlaceByteShift)});
  return b.or_(shifted, b.constant(Type::I64, nc::placeArgument(at.space.index, 0, bit)));
}

ValueId limit(Lowering& l, const Operand& cell) {
  return cell.given() ? placeOf(l, cell, 0) : l.b().constant(Type::I64, nc::kNoPlace);
}

void share(Lowering& l, int64_t what, const Operand& id, std::array<ValueId, 3> places) {
  ir::RungBuilder& b = l.b();
  const ValueId head[] = {b.constant(Type::I64, what), places[0], places[1], places[2]};
  const ValueId ticket = defineRequest(l, head, id);
  l.r().setRlo(answersYes(b, ticket, 0));
}

bool limitsFit(Lowering& l, ExchangeType type, std::span<const Operand> o) {
  const bool text = nc::isText(type);
  const Operand &least = o[3], &most = o[4];
  if (least.form == Operand::Form::Real)
    return OperandParser::wrongKind(l.program(), least, "a constant", "a real cell");
  if (text && most.given()) return OperandParser::wrongKind(l.program(), most, "a limit", "none with a text");
  if (text && least.form == Operand::Form::Cell)
    return OperandParser::wrongKind(l.program(), least, "a cell", "a length, which is a constant");
  if (!text && least.form == Operand::Form::Integer)
    return OperandParser::wrongKind(l.program(), least, "a length", "a real cell");
  if (!text || !least.given()) return true;
  if (least.value >= 1 && least.value <= o[0].size) return true;
  l.program().diagnostics.report(Diag::OperandRange, least.range) << least.value << "1 to " + std::to_string(o[0].size);
  return false;
}

} // namespace

// SHARE_VAR variable, name, type [, least [, most]] or text, name, type [, length].
void lowerShareVariable(Lowering& l, std::span<const Operand> o, int) {
  const ExchangeType type = nc::exchangeTypeOf(o[2].value);
  const bool text = nc::isText(type);
  const bool possible = type != ExchangeType::Bit ||
                        OperandParser::wrongKind(l.program(), o[2], "the type of a bit", "that of a number or a text");
  if (!identifierFits(l, o[1], false) || !possible || !limitsFit(l, type, o)) return;
  const uint32_t count = !text ? 1 : o[3].given() ? static_cast<uint32_t>(o[3].value) : o[0].size;
  const std::array<ValueId, 3> places = {placeOf(l, o[0], 0), limit(l, text ? Operand{} : o[3]), limit(l, o[4])};
  share(l, nc::exchangeArgument(ExchangeKind::Variable, type, ExchangePeriod::Slow, count), o[1], places);
}

// SHARE_BIT byte, name, bit
void lowerShareBit(Lowering& l, std::span<const Operand> o, int) {
  if (!identifierFits(l, o[1], false)) return;
  const std::array<ValueId, 3> places = {placeOf(l, o[0], o[2].place.bit), limit(l, {}), limit(l, {})};
  share(l, nc::exchangeArgument(ExchangeKind::Bit, ExchangeType::Bit, ExchangePeriod::Slow, 1), o[1], places);
}

} // namespace rung::frontend::technol
