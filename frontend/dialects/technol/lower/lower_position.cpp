// The positioning unit: the program controls motions of an axis through two records of its own (man. ch. 19).
#include "frontend/dialects/technol/lower/device_request.h"
#include "frontend/dialects/technol/lower/lower.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

constexpr uint32_t kRecordBytes = 2, kBits = 1; // the second byte holds the bits of the control record (man. l.12101)
constexpr int64_t kMp = 1, kControlBits = 15;

// Where the reference to the control record of an axis (i64) is stored.
struct KeptRecord {
  ir::Window window;
  ValueId index;
};
KeptRecord keptOf(ir::RungBuilder& b, ValueId axis) {
  const ir::Place at = place(HostCell::PositionControl);
  const ValueId number = b.zextOrTrunc(Type::I32, b.sub(axis, b.constant(Type::I64, 1)));
  return {.window = {.space = at.space, .byte = at.byte, .count = (kMostAxes - 1) * 8 + 1},
          .index = b.mul(number, b.i32(8))};
}

// Merges the bits of a control record that the unit writes; the others do not change (man. l.12101-12133).
ValueId withBits(ir::RungBuilder& b, ValueId byte, ValueId mask, ValueId bits) {
  return b.or_(b.and_(byte, b.not_(mask)), b.and_(bits, mask));
}

// Writes bits to the record that the last POS_MODE of the axis named, in whichever memory it is.
void writeKept(Memory& memory, ValueId axis, ValueId mask, ValueId bits) {
  ir::RungBuilder& b = memory.emitter().b();
  const KeptRecord kept = keptOf(b, axis);
  const ValueId record = b.loadAt(Type::I64, kept.window, kept.index);
  const ValueId at = b.zextOrTrunc(Type::I32, record);
  for (const ir::SpaceId space : {kInterfaceSpace, kDataSpace}) {
    const Area area{.space = space, .bytes = memory.bytesOf(space), .fixed = false, .first = 0, .at = at};
    if (area.bytes < kRecordBytes) continue;
    const int64_t head = nc::technol::bytesArgument(space.index, kRecordBytes, 0);
    const ValueId isThere =
        b.eq(b.and_(record, b.constant(Type::I64, ~int64_t{0xFFFF'FFFF})), b.constant(Type::I64, head));
    b.when(isThere,
           [&] { storeByte(b, area, b.i32(kBits), withBits(b, loadByte(b, area, b.i32(kBits)), mask, bits)); });
  }
}

} // namespace

// POS_MODE control,len,accel,axis: starts the initiator without allowing the motion yet (man. l.12205-12238). If the
// unit refuses, the record does not change, and POS_CONTROL continues to use the previous one.
void lowerPositionMode(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  const Area record = areaOf(l.memory, o[0]);
  DeviceRequest request(l);
  request.addOperand(1, o[1]);
  request.addOperand(2, o[2]);
  const ValueId axis = request.addOperand(3, o[3]);
  request.send();
  const ValueId bits = request.result("control");
  const ValueId taken = b.ne(bits, b.constant(Type::I64, nc::technol::kNotGiven));
  const KeptRecord kept = keptOf(b, axis);
  b.when(b.and_(taken, isAxis(b, axis)), [&] {
    const ValueId mask = b.constant(Type::I8, kControlBits);
    storeByte(b, record, b.i32(kBits),
              withBits(b, loadByte(b, record, b.i32(kBits)), mask, b.zextOrTrunc(Type::I8, bits)));
    b.storeAt(kept.window, kept.index, bytesArgument(l.emitter, record, b.i32(kRecordBytes)));
  });
}

// POS_CONTROL status,feed,[mp],axis: if mp is omitted, the motion is allowed (inventory of the services, 6).
void lowerPositionControl(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  const Area status = areaOf(l.memory, o[0]);
  const ValueId allowed = o[2].given() ? l.memory.bit(o[2]) : b.bit(true);
  DeviceRequest request(l);
  request.addOperand(1, o[1]);
  request.add(b.zextOrTrunc(Type::I64, allowed));
  const ValueId axis = request.addOperand(3, o[3]);
  request.send();
  const ValueId word = request.result("status"), control = request.result("control");
  const ValueId none = b.constant(Type::I64, nc::technol::kNotGiven);
  b.when(b.ne(word, none), [&] { storeByte(b, status, b.i32(0), b.zextOrTrunc(Type::I16, word)); });
  const ValueId known = b.ne(control, none);
  const ValueId mask = b.select(known, b.constant(Type::I8, kControlBits), b.constant(Type::I8, kMp));
  const ValueId mp = b.zextOrTrunc(Type::I8, allowed);
  const ValueId bits = b.or_(b.and_(b.zextOrTrunc(Type::I8, control), b.constant(Type::I8, kControlBits - kMp)), mp);
  writeKept(l.memory, axis, mask, bits);
}

} // namespace rung::frontend::technol
