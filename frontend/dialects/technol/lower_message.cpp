// Messages: ESET and ESET1 (man. ch. 14.3).
#include "frontend/dialects/technol/lower.h"
#include "frontend/dialects/technol/lowering.h"

#include "rtlib/nc/technol/messages.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

// As rtlib/nc/technol/messages.h joins them.
struct MessageParts {
  ValueId number; // i32
  ValueId subId, par3;
  ValueId pars; // par1 and above it par2
};

ValueId valueOr0(Lowering& l, const Operand& operand, Type type) {
  return operand.given() ? l.b().zextOrTrunc(type, l.value(operand)) : l.b().constant(type, 0);
}

MessageParts partsOf(Lowering& l, ValueId number, const Operand& subId, std::span<const Operand> pars) {
  ir::RungBuilder& b = l.b();
  const auto wide = [&](const Operand& par) { return b.zextOrTrunc(Type::I64, valueOr0(l, par, Type::I32)); };
  const ValueId low = wide(pars[0]);
  const ValueId high = b.op(ir::OpCode::Shl, Type::I64, {wide(pars[1]), b.i32(32)});
  return {number, valueOr0(l, subId, Type::I32), valueOr0(l, pars[2], Type::I32), b.or_(low, high)};
}

void send(ir::RungBuilder& b, const MessageParts& m, uint32_t op, uint32_t marks) {
  b.message(op, b.or_(m.number, b.i32(static_cast<int32_t>(marks))), m.par3, m.subId, m.pars);
}

// `set` 1 shows and 0 removes; without it the message is shown.
void showOrRemove(ir::RungBuilder& b, const MessageParts& m, ValueId set) {
  if (!set.valid()) return send(b, m, RUNG_MESSAGE_SHOW_LOG, 0);
  b.if_(set);
  send(b, m, RUNG_MESSAGE_SHOW_LOG, nc::technol::kPersistentWanted);
  b.else_();
  send(b, m, RUNG_MESSAGE_CLEAR, nc::technol::kPersistentWanted);
  b.endIf();
}

} // namespace

// ESET [error],[subid],[set],[par1],[par2],[par3]; the number is in DR where it is not given (man. l.5086-5130).
// _ON_ESET is called with the number in DR when a message comes up, not when one is removed (man. l.1609, l.5132).
void lowerMessage(Lowering& l, std::span<const Operand> o, int condition) {
  ir::RungBuilder& b = l.b();
  const ValueId word = o[0].given() ? b.zextOrTrunc(Type::I16, l.value(o[0])) : l.r().dr(Type::I16);
  const ValueId number = b.zextOrTrunc(Type::I32, word);
  ValueId set;
  if (o[2].given()) {
    const ValueId value = valueOr0(l, o[2], Type::I32);
    set = b.ne(value, b.i32(0));
  }
  const MessageParts message = partsOf(l, number, o[1], o.subspan(3, 3));
  const ValueId rlo = condition == kIfRlo ? l.r().rlo() : ValueId{};
  const bool calls = l.onMessage() != kNone && l.currentProcedure() != l.onMessage();
  const ValueId comesUp = !set.valid() ? rlo : !rlo.valid() ? set : b.and_(rlo, set);
  if (calls) l.saveRegisters();
  if (rlo.valid()) b.if_(rlo);
  showOrRemove(b, message, set);
  if (rlo.valid()) b.endIf();
  if (!calls) return;
  l.r().setDr(b.zextOrTrunc(Type::I64, number));
  l.callProcedure(l.onMessage(), l.statement().range(), comesUp);
  l.restoreRegisters();
}

} // namespace rung::frontend::technol
