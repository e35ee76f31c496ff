// PLC axis control and instructions on positions (§9, §10; man. l.3241-3555, 7591-7803).
#include <vector>

#include "frontend/dialects/gsk/lower/lower.h"
#include "frontend/network/lower/axis.h"
#include "rtlib/nc/gsk/axis_commands.h"

namespace rung::frontend::gsk {

// P53: bit 5 of the result says that the command is unknown; the compiler checks groups.
void lowerAxisControl(Lowering& f) {
  using ir::Type;
  constexpr int64_t kUnknownCommand = 1 << 5;
  network::controlAxes(f, {.group = nc::gsk::axisGroups()[static_cast<size_t>(f.param(0).value - 1)],
                           .commands = nc::gsk::axisCommands(),
                           .g = areas::kG,
                           .f = areas::kF,
                           .report = [&](ir::ValueId isUnknown) {
                             const ir::ValueId unknown = f.b.constant(Type::I8, kUnknownCommand);
                             f.store(f.param(2).address, f.b.select(isUnknown, unknown, f.b.constant(Type::I8, 0)));
                           }});
}

// Instructions on the position of a machine axis (§10; man. l.3397-3555).

namespace {

using ir::Type;
using ir::ValueId;

constexpr uint32_t kZones = 8;
// The CNC provides the machine positions of axes 1-8 (axis signals are 1-8 as well, man. l.3368).
constexpr uint32_t kMachineAxes = 8;
constexpr uint32_t kPositionBytes = 4;

// Space that the NC writes before each slot: axis n at byte 4(n-1), in 0.001 mm. Programs that do not read positions do
// not have it.
ir::Window machinePositions(Lowering& f) {
  return f.hidden("@MPOS", kPositionBytes * kMachineAxes, kPositionBytes * (kMachineAxes - 1) + 1);
}

// A block with the axis number in one byte, then limits of 4 bytes (man. l.3437-3447; P56).
struct Limits {
  ValueId position;            // 0 for an axis that does not exist
  std::vector<ValueId> values; // signed, in 0.001 mm
  ValueId result;              // bit 0: the axis does not exist, bit 1: limits not ascending (P55)
  ValueId good;
};

Limits limitsOf(Lowering& f, uint32_t count) {
  ir::RungBuilder& b = f.b;
  network::Address address = f.param(0).address;
  const ValueId axis = b.sub(b.zextOrTrunc(Type::I32, f.load(Type::I8, address)), b.i32(1));
  Limits limits;
  limits.position = b.loadAt(Type::I32, machinePositions(f), b.mul(axis, b.i32(kPositionBytes)));
  address.byte += 1;
  for (uint32_t i = 0; i < count; ++i, address.byte += 4) limits.values.push_back(f.load(Type::I32, address));
  ValueId descending = b.bit(false);
  for (uint32_t i = 1; i < count; ++i) descending = b.or_(descending, b.ltS(limits.values[i], limits.values[i - 1]));
  const ValueId noAxis = b.leU(b.i32(kMachineAxes), axis);
  limits.result = b.select(noAxis, b.constant(Type::I8, 1), b.constant(Type::I8, 0));
  limits.result = b.or_(limits.result, b.select(descending, b.constant(Type::I8, 2), b.constant(Type::I8, 0)));
  limits.good = b.not_(b.or_(noAxis, descending));
  return limits;
}

} // namespace

// Bit 7 is the zone below limit I; each limit that the position has reached moves the bit one place down.
void lowerPositionZones(Lowering& f) {
  f.b.when(f.act(), [&] {
    ir::RungBuilder& b = f.b;
    const Limits limits = limitsOf(f, kZones - 1);
    ValueId zone = b.i32(0);
    for (ValueId limit : limits.values) zone = b.add(zone, b.zextOrTrunc(Type::I32, b.leS(limit, limits.position)));
    const ValueId bits = b.shrU(b.constant(Type::I8, 0x80), zone);
    f.store(f.param(1).address, b.select(limits.good, bits, b.constant(Type::I8, 0)));
    f.store(f.param(2).address, limits.result);
  });
}

// Both limits are part of the zone (man. l.3555).
void lowerPositionRange(Lowering& f) {
  f.latchedOutput(f.act(), {}, [&] {
    ir::RungBuilder& b = f.b;
    const Limits limits = limitsOf(f, 2);
    f.store(f.param(1).address, limits.result);
    const ValueId inside = b.and_(b.leS(limits.values[0], limits.position), b.leS(limits.position, limits.values[1]));
    return b.and_(inside, limits.good);
  });
}

} // namespace rung::frontend::gsk
