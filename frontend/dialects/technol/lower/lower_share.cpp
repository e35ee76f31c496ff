// Variables that screens see by a name (man. ch. 18.2).
#include <array>

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

// Where an operand lies, as an argument; BX is taken now.
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

} // namespace rung::frontend::technol
