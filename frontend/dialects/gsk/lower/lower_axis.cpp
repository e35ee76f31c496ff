// PLC axis control: passes command blocks to the CNC through the signals of a group (§9; man. l.3241-3393, 7591-7803).
#include <vector>

#include "frontend/dialects/gsk/lower/lower.h"
#include "rtlib/nc/gsk/axis_commands.h"

namespace rung::frontend::gsk {
namespace {

using ir::Type;
using ir::ValueId;
namespace axis = nc::pmc;

enum : uint8_t { kIdle, kSent, kDone };
constexpr int64_t kUnknownCommand = 1 << 5; // bit of the result (P53); the compiler checks groups

struct Step {
  ValueId state, out;
};

class AxisLowering {
public:
  explicit AxisLowering(Lowering& f)
      : f_(f), b_(f.b), group_(nc::gsk::axisGroups()[static_cast<size_t>(f.param(0).value - 1)]) {}
  void run();

private:
  network::Address bit(network::Area area, uint32_t byte, uint8_t number) const { return {area, byte, number, true}; }
  network::Address buffer() const { return bit(areas::kG, group_.control, axis::kEbufBit); }
  network::Address data(uint32_t offset) const { return plus(f_.param(1).address, offset); }
  ValueId state(uint8_t value) { return b_.constant(Type::I8, value); }
  ValueId isKnown(ValueId command);
  Step call(ValueId ready);
  Step idle(ValueId ready);
  void send();

  Lowering& f_;
  ir::RungBuilder& b_;
  const axis::AxisGroup& group_;
};

ValueId AxisLowering::isKnown(ValueId command) {
  uint64_t set = 0;
  for (const axis::AxisCommand& known : nc::gsk::axisCommands()) set |= uint64_t{1} << known.code;
  return isIn(b_, b_.and_(command, b_.constant(Type::I8, axis::kAxisCommandBits)), set);
}

// Writes the seven bytes, EMSBK and EC first (P51); then a change of EBUF reports them to the CNC (man. l.7672).
void AxisLowering::send() {
  const auto signal = [](uint32_t byte) { return network::Address{areas::kG, byte}; };
  const ValueId command = f_.load(Type::I8, data(axis::kAxisCommandAt));
  const ValueId data1 = f_.load(Type::I16, data(axis::kAxisData1At));
  const ValueId data2 = f_.load(Type::I32, data(axis::kAxisData2At));
  f_.store(signal(group_.command), command);
  f_.store(signal(group_.data1()), data1);
  f_.store(signal(group_.data2()), data2);
  f_.store(buffer(), b_.not_(f_.load(Type::Bit, buffer())));
  f_.store(f_.param(2).address, state(0));
}

// The step for ACT=1 in the idle state.
Step AxisLowering::idle(ValueId ready) {
  return b_.choose(
      isKnown(f_.load(Type::I8, data(axis::kAxisCommandAt))),
      [&] {
        b_.when(ready, [&] { send(); });
        return Step{b_.select(ready, state(kSent), state(kIdle)), b_.bit(false)};
      },
      [&] {
        f_.store(f_.param(2).address, b_.constant(Type::I8, kUnknownCommand));
        return Step{state(kDone), b_.bit(true)};
      });
}

// The step for RST=0. OUT becomes 1 when EBSY equals EBUF, independent of ACT (man. l.3322), and 0 when ACT is 0.
Step AxisLowering::call(ValueId ready) {
  const ValueId old = b_.slotLoad(f_.slot("state", Type::I8));
  return b_.choose(
      b_.and_(f_.act(), b_.eq(old, state(kIdle))), [&] { return idle(ready); },
      [&] {
        const ValueId sent = b_.eq(old, state(kSent));
        const ValueId done = b_.eq(old, state(kDone));
        const ValueId out = b_.select(sent, ready, b_.and_(done, f_.act()));
        const ValueId stays = b_.and_(sent, b_.not_(ready));
        return Step{b_.select(out, state(kDone), b_.select(stays, state(kSent), state(kIdle))), out};
      });
}

void AxisLowering::run() {
  const ValueId reset = f_.condition(0);
  f_.store(bit(areas::kG, group_.control, axis::kEclrBit), reset);
  const Step step = b_.choose(
      reset, [&] { return Step{state(kIdle), b_.bit(false)}; },
      [&] {
        return call(
            b_.eq(f_.load(Type::Bit, buffer()), f_.load(Type::Bit, bit(areas::kF, group_.status, axis::kEbsyBit))));
      });
  b_.slotStore(f_.slot("state", Type::I8), step.state);
  f_.setOutput(step.out);
}

} // namespace

void lowerAxisControl(Lowering& f) { AxisLowering(f).run(); }

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
  ValueId position;            // 0 if there is no such axis
  std::vector<ValueId> values; // signed, in 0.001 mm
  ValueId result;              // bit 0: no such axis, bit 1: limits not ascending (P55)
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
