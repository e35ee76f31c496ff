// CAN bus and serial ports.
#include <algorithm>

#include "frontend/dialects/technol/lower/device_request.h"
#include "frontend/dialects/technol/lower/lower.h"

namespace rung::frontend::technol {

// CAN bus: packets, requests for packets, units, drives (man. ch. 9.4, 9.5, 13.14).

using ir::Type;
using ir::ValueId;

namespace {

// TCANMSGS (man. l.9497-9511).
constexpr uint32_t kId = 0, kRtr = 2, kLength = 3, kData = 4, kDataBytes = 8, kPacketBytes = kData + kDataBytes;
constexpr int64_t kIdBits = 0x7FF;
// Identifier base of packets to a drive: service data request (man. l.9203, l.9488).
constexpr int64_t kServiceDataId = 0x600;

ValueId memberOf(ir::RungBuilder& b, const Area& packet, uint32_t offset, Type type) {
  return b.zextOrTrunc(Type::I64, loadByte(b, packet, b.i32(offset), type));
}
void setMember(ir::RungBuilder& b, const Area& packet, uint32_t offset, Type type, ValueId value) {
  storeByte(b, packet, b.i32(offset), b.zextOrTrunc(type, value));
}
Area dataOf(ir::RungBuilder& b, const Area& packet) { return shifted(b, packet, b.i32(kData)); }

} // namespace

// Sends a packet of at most 8 bytes; a larger length counts as 8. DR says whether the queue accepted it (man.
// l.3709-3742).
void lowerCanSend(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  const Area packet = areaOf(l.memory, o[1]);
  const ValueId length = memberOf(b, packet, kLength, Type::I8), most = b.constant(Type::I64, kDataBytes);
  const ValueId count = b.select(b.ltU(length, most), length, most);
  DeviceRequest request(l);
  request.addOperand(0, o[0]);
  request.add(b.and_(memberOf(b, packet, kId, Type::I16), b.constant(Type::I64, kIdBits)));
  request.add(memberOf(b, packet, kRtr, Type::I8));
  request.add(count);
  request.add(bytesArgument(l.emitter, dataOf(b, packet), b.zextOrTrunc(Type::I32, count)));
  request.send();
  l.r().setDr(request.result("DR"));
}

// Stores a received packet; DR is 0 if there was one (man. l.3743-3778).
void lowerCanReceive(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  const Area packet = areaOf(l.memory, o[1]);
  DeviceRequest request(l);
  request.addOperand(0, o[0]);
  const ValueId ticket = request.send();
  const ValueId code = request.result("DR");
  const ValueId id = request.result("id"), rtr = request.result("rtr"), length = request.result("data");
  b.when(b.eq(code, b.constant(Type::I64, 0)), [&] {
    setMember(b, packet, kId, Type::I16, id);
    setMember(b, packet, kRtr, Type::I8, rtr);
    setMember(b, packet, kLength, Type::I8, length);
    setMember(b, packet, kData, Type::I64, b.constant(Type::I64, 0));
    fetchBytes(l.emitter, ticket, dataOf(b, packet), b.zextOrTrunc(Type::I32, length), kDataBytes);
  });
  l.r().setDr(code);
}

// CAN_RECV_REQ can, objl, [objh], idl, [idh], proc, pmsg: an omitted upper bound equals the lower one (man.
// l.3814-3831).
void lowerCanOrder(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  DeviceRequest request(l);
  request.addOperand(0, o[0]);
  for (const uint32_t low : {1u, 3u}) {
    request.addOperand(low, o[low]);
    request.addOperand(low + 1, o[low + 1].given() ? o[low + 1] : o[low]);
  }
  request.add(l.procedures.event(o[5].index));
  request.add(bytesArgument(l.emitter, areaOf(l.memory, o[6]), b.i32(kPacketBytes)));
  request.send();
  l.r().setRlo(request.flag("RLO"));
  l.r().setDr(request.result("DR"));
}

// On an error RLO is 1 and DR does not change (man. l.4296-4299).
void lowerUnitRead(Lowering& l, std::span<const Operand> o, int) {
  DeviceRequest request(l);
  for (uint32_t i = 0; i < o.size(); ++i) request.addOperand(i, o[i]);
  request.send();
  const ValueId failed = request.flag("RLO");
  l.r().setDr(l.b().select(failed, l.r().dr(Type::I64), request.result("DR")));
  l.r().setRlo(failed);
}

void lowerUnitWrite(Lowering& l, std::span<const Operand> o, int) {
  DeviceRequest request(l);
  for (uint32_t i = 0; i < o.size(); ++i) request.addOperand(i, o[i]);
  request.add(l.r().dr(Type::I64));
  request.send();
  l.r().setRlo(request.flag("RLO"));
}

// Fills in the packet's head; CAN_AX_BUSY is 0FFh until the drive has answered (man. l.9474-9493).
void lowerDriveSend(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  const Area packet =
      fixedArea(l.emitter, kInterfaceSpace, l.memory.bytesOf(kInterfaceSpace), placeOf("CAN_AX_SEND_PACKET").byte);
  DeviceRequest request(l);
  const ValueId axis = request.addOperand(0, o[0]);
  b.when(isAxis(b, axis), [&] {
    setMember(b, packet, kId, Type::I16, b.add(axis, b.constant(Type::I64, kServiceDataId)));
    setMember(b, packet, kRtr, Type::I8, b.constant(Type::I64, 0));
    setMember(b, packet, kLength, Type::I8, b.constant(Type::I64, kDataBytes));
    b.store(placeOf("CAN_AX_BUSY"), b.constant(Type::I8, 0xFF));
  });
  request.add(bytesArgument(l.emitter, dataOf(b, packet), b.i32(kDataBytes)));
  request.send();
}

// Serial ports (man. ch. 23.3); lowerService lowers instructions that send several characters.

using ir::Type;
using ir::ValueId;

// COM_SEND com [,val]: without the operand, sends the low byte of DR (man. l.21063).
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

// COM_RECV com [,val]: RLO is 0 if there was a character, which is stored in val or DR (man. l.21138-21152).
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

// COM_CONTROL com,CLEAR|RECEIVED|STATE: CLEAR does not change DR (man. l.21165-21198).
void lowerComControl(Lowering& l, std::span<const Operand> o, int) {
  DeviceRequest request(l);
  request.addOperand(0, o[0]);
  request.addOperand(1, o[1]);
  request.send();
  l.r().setRlo(request.flag("RLO"));
  if (o[1].value != nc::technol::kFirstLineCommand) l.r().setDr(request.result("DR"));
}

} // namespace rung::frontend::technol
