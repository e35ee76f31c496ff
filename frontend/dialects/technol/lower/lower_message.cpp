// Messages: ESET, ESET1, EDEF (man. ch. 14.3).
#include <algorithm>

#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lowering.h"
#include "frontend/dialects/technol/lower/message_parts.h"
#include "rtlib/nc/technol/services.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

MessageParts partsOf(Memory& memory, ValueId number, const Operand& subId, std::span<const Operand> pars) {
  const ValueId par1 = valueOr0(memory, pars[0], Type::I32), par2 = valueOr0(memory, pars[1], Type::I32);
  const ValueId both = bothPars(memory.emitter().b(), par1, par2);
  return {number, valueOr0(memory, subId, Type::I32), valueOr0(memory, pars[2], Type::I32), both};
}

// `set` 1 shows and 0 removes; without it the message is shown.
void showOrRemove(ir::RungBuilder& b, const MessageParts& m, ValueId set) {
  if (!set.valid()) return send(b, m, RUNG_MESSAGE_SHOW_LOG, 0);
  const auto give = [&](uint32_t op) { return [&, op] { send(b, m, op, nc::technol::kPersistentWanted); }; };
  b.when(set, give(RUNG_MESSAGE_SHOW_LOG), give(RUNG_MESSAGE_CLEAR));
}

} // namespace

// ESET [error],[subid],[set],[par1],[par2],[par3]; the number is in DR where it is not given (man. l.5086-5130).
// _ON_ESET is called with the number in DR when a message comes up, not when one is removed (man. l.1609, l.5132).
void lowerMessage(Lowering& l, std::span<const Operand> o, int condition) {
  ir::RungBuilder& b = l.b();
  const ValueId word = o[0].given() ? b.zextOrTrunc(Type::I16, l.memory.value(o[0])) : l.r().dr(Type::I16);
  const ValueId number = b.zextOrTrunc(Type::I32, word);
  ValueId set;
  if (o[2].given()) {
    const ValueId value = valueOr0(l.memory, o[2], Type::I32);
    set = b.ne(value, b.i32(0));
  }
  const MessageParts message = partsOf(l.memory, number, o[1], o.subspan(3, 3));
  const ValueId rlo = l.guardOf(condition);
  const bool calls =
      l.procedures.onMessage() != kNone && l.program.source.procedureOf(l.statement().unit) != l.procedures.onMessage();
  const ValueId comesUp = !set.valid() ? rlo : !rlo.valid() ? set : b.and_(rlo, set);
  if (calls) l.procedures.saveRegisters();
  b.when(rlo, [&] { showOrRemove(b, message, set); });
  if (!calls) return;
  l.r().setDr(b.zextOrTrunc(Type::I64, number));
  l.callProcedure(l.procedures.onMessage(), comesUp);
  l.procedures.restoreRegisters();
}

namespace {

constexpr uint32_t kMostEntries = 64; // of one EDEF

} // namespace

// EDEF [val],bit,error,[subid],mod,[par1],[par2],[par3] (man. l.5192-5260). Carried out again it is the same message
// while number and addresses are the same, else one more.
void lowerBitMessage(Lowering& l, std::span<const Operand> o, int) {
  const ValueId word = l.b().zextOrTrunc(Type::I16, l.memory.value(o[2]));
  const ValueId number = l.b().zextOrTrunc(Type::I32, word), subId = valueOr0(l.memory, o[3], Type::I32);
  BitMessage message{.statement = &l.statement(), .pars = o.subspan(5, 3), .mode = static_cast<uint32_t>(o[4].value)};
  message.places[0] = l.memory.reach(o[0].given() ? o[0] : o[1]);
  message.places[0].place.bit = o[1].place.bit;
  for (size_t i = 0; i < message.pars.size(); ++i) message.places[1 + i] = l.memory.reach(message.pars[i]);
  const bool varies = !o[2].isConstant() || (o[3].given() && !o[3].isConstant()) ||
                      std::ranges::any_of(message.places, &MemoryAccess::indexed);
  message.capacity = varies ? kMostEntries : 1;
  l.bitMessages.add(message, number, subId);
}

} // namespace rung::frontend::technol
