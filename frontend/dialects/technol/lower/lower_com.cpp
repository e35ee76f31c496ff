// Serial ports (man. ch. 23.3); what sends several characters is lowerService.
#include "frontend/dialects/technol/lower/device_request.h"
#include "frontend/dialects/technol/lower/lower.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

// COM_SEND com [,val]: without the operand the low byte of DR (man. l.21063).
void lowerComSend(Lowering& l, std::span<const Operand> o, int) {
  DeviceRequest request(l);
  request.addOperand(0, o[0]);
  if (o[1].given())
    request.addOperand(1, o[1]);
  else
    request.add(l.b().zextOrTrunc(Type::I64, l.r().dr(Type::I8)));
  request.send();
  l.r().setRlo(request.flag("RLO"));
}

// COM_RECV com [,val]: RLO is 0 where a character was there, which val or DR becomes (man. l.21138-21152).
void lowerComReceive(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  const MemoryAccess target = o[1].given() ? l.memory.reach(o[1]) : MemoryAccess{};
  DeviceRequest request(l);
  request.addOperand(0, o[0]);
  request.send();
  const ValueId none = request.flag("RLO"), character = request.result("DR");
  if (o[1].given())
    b.when(b.not_(none), [&] { l.memory.store(target, b.zextOrTrunc(o[1].type, character)); });
  else
    l.r().setDr(b.select(none, l.r().dr(Type::I64), character));
  l.r().setRlo(none);
}

// COM_CONTROL com,CLEAR|RECEIVED|STATE: the first leaves DR alone (man. l.21165-21198).
void lowerComControl(Lowering& l, std::span<const Operand> o, int) {
  DeviceRequest request(l);
  request.addOperand(0, o[0]);
  request.addOperand(1, o[1]);
  request.send();
  l.r().setRlo(request.flag("RLO"));
  if (o[1].value != nc::technol::kFirstLineCommand) l.r().setDr(request.result("DR"));
}

} // namespace rung::frontend::technol
