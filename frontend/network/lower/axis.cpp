// See axis.h.
#include "frontend/network/lower/axis.h"

namespace rung::frontend::network {
namespace {

using ir::Type;
using ir::ValueId;
namespace axis = nc::pmc;

enum : uint8_t { kIdle, kSent, kDone };

struct Step {
  ValueId state, out;
};

class AxisLowering {
public:
  AxisLowering(Lowering& f, const AxisControl& control) : f_(f), b_(f.b), control_(control), group_(control.group) {}
  void run();

private:
  Address bit(Area area, uint32_t byte, uint8_t number) const { return {area, control_.offset + byte, number, true}; }
  Address buffer() const { return bit(control_.g, group_.control, axis::kEbufBit); }
  Address data(uint32_t offset) const { return plus(f_.param(1).address, offset); }
  ValueId state(uint8_t value) { return b_.constant(Type::I8, value); }
  ValueId isKnown(ValueId command);
  Step call(ValueId ready);
  Step idle(ValueId ready);
  void send();

  Lowering& f_;
  ir::RungBuilder& b_;
  const AxisControl& control_;
  const axis::AxisGroup& group_;
};

ValueId AxisLowering::isKnown(ValueId command) {
  uint64_t set = 0;
  for (const axis::AxisCommand& known : control_.commands) set |= uint64_t{1} << known.code;
  return isIn(b_, b_.and_(command, b_.constant(Type::I8, axis::kAxisCommandBits)), set);
}

// Writes the seven bytes, EMSBK and EC first (P51); then a change of EBUF reports them to the CNC (man. l.7672).
void AxisLowering::send() {
  const auto signal = [&](uint32_t byte) { return Address{control_.g, control_.offset + byte}; };
  const ValueId command = f_.load(Type::I8, data(axis::kAxisCommandAt));
  const ValueId data1 = f_.load(Type::I16, data(axis::kAxisData1At));
  const ValueId data2 = f_.load(Type::I32, data(axis::kAxisData2At));
  f_.store(signal(group_.command), command);
  f_.store(signal(group_.data1()), data1);
  f_.store(signal(group_.data2()), data2);
  f_.store(buffer(), b_.not_(f_.load(Type::Bit, buffer())));
  control_.report(b_.bit(false));
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
        control_.report(b_.bit(true));
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
  f_.store(bit(control_.g, group_.control, axis::kEclrBit), reset);
  const Step step = b_.choose(
      reset, [&] { return Step{state(kIdle), b_.bit(false)}; },
      [&] {
        return call(
            b_.eq(f_.load(Type::Bit, buffer()), f_.load(Type::Bit, bit(control_.f, group_.status, axis::kEbsyBit))));
      });
  b_.slotStore(f_.slot("state", Type::I8), step.state);
  f_.setOutput(step.out);
}

} // namespace

void controlAxes(Lowering& f, const AxisControl& control) { AxisLowering(f, control).run(); }

} // namespace rung::frontend::network
