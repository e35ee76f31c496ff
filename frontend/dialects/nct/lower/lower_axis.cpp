// MOVCMND: commands for an axis that the PLC moves (man. §6.15, l.3052-3155).
#include "frontend/dialects/nct/lower/lower.h"
#include "ir/support/check.h"
#include "rtlib/nc/nct/axis_codes.h"
#include "rtlib/nc/nct/signals.h"

namespace rung::frontend::nct {

using ir::RungBuilder;
using ir::Type;
using ir::ValueId;

namespace {

// The signal of the axis with this index, which must be in range.
ValueId axisSignal(Lowering& box, std::string_view symbol, ValueId axis) {
  const nc::Signal* signal = nc::findSignal(nc::nctSignals(), symbol);
  RUNG_CHECK(signal != nullptr && signal->count == nc::nct::kAxes, "a signal of the axes");
  const ir::Window axes{
      .space = box.memory.word({}, AccessBound::Read).space, .byte = signal->byteOffset, .count = signal->count};
  return box.b.loadBitAt(axes, axis, box.b.i32(signal->bit));
}

// Whether axis and code exist, the PLC owns the axis (l.3120), and a movement with feed has a feed (l.3124).
ValueId isProper(Lowering& box, ValueId axis, ValueId code, ValueId speed) {
  RungBuilder& b = box.b;
  ValueId needsSpeed = b.bit(false);
  for (const nc::nct::AxisCode& known : nc::nct::axisCodes())
    if (known.needsSpeed()) needsSpeed = b.or_(needsSpeed, b.eq(code, b.i32(known.code)));
  const ValueId stopped = b.fEq(speed, b.real(0));
  const ValueId requested = b.and_(axisSignal(box, "AP_PLCR", axis), axisSignal(box, "AN_PLCA", axis));
  const auto codes = static_cast<int64_t>(nc::nct::axisCodes().size());
  const ValueId inRange = b.and_(b.ltU(axis, b.i32(nc::nct::kAxes)), b.ltU(code, b.i32(codes)));
  return b.and_(b.and_(inRange, requested), b.not_(b.and_(needsSpeed, stopped)));
}

} // namespace

// Sends the command if the axis' buffer of one block is empty (l.3062). The NC accepts it without an answer; a host
// that refuses it cannot execute the instruction.
ValueId lowerAxisCommand(Lowering& box) {
  RungBuilder& b = box.b;
  Memory& memory = box.memory;
  return execute(box, [&] {
    ValueId valid;
    const ValueId axis = memory.integer(box.operands[0], valid);
    const ValueId code = memory.integer(box.operands[1], valid);
    const ValueId speed = memory.real(box.operands[2], valid);
    const ValueId distance = memory.real(box.operands[3], valid);
    valid = memory.both(valid, isProper(box, axis, code, speed));
    return guarded(box, valid, [&] {
      const auto send = [&] {
        const auto bits = [&](ValueId real) { return b.fToBits(real); };
        const ValueId args[] = {b.zextOrTrunc(Type::I64, axis), b.zextOrTrunc(Type::I64, code), bits(speed),
                                bits(distance)};
        const ValueId ticket = b.serviceRequest(box.shared.service(nc::nct::ServiceKind::MoveAxis), args);
        const ValueId refused = b.eq(b.servicePoll(ticket), b.i32(RUNG_SERVICE_ERROR));
        memory.setFlag(kFlagEr, refused);
        return b.and_(b.ne(ticket, b.i32(0)), b.not_(refused));
      };
      return b.choose(axisSignal(box, "AN_BEPTY", axis), send, [&] {
        memory.setErrorFlag(false);
        return b.bit(false);
      });
    });
  });
}

} // namespace rung::frontend::nct
