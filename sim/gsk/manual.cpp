// Manual motion (see manual.h).
#include "sim/gsk/manual.h"

#include <cmath>

namespace rung::sim::gsk {
namespace {

constexpr int64_t kIncrement = 10; // 0.001 mm, in units

// x1 x10 x100 x1000 by MP2 MP1, a tenth with MPSELT (l.4609-4613); the second wheel has bits of its own (l.4632).
int64_t increment(const nc::gsk::SignalsIo& io, uint32_t wheel) {
  constexpr int64_t kPowers[] = {1, 10, 100, 1000};
  const uint8_t bits = wheel == 2 ? io.gByte(87) : io.gByte(19);
  const int64_t units = kIncrement * kPowers[(bits >> 4) & 3];
  return wheel == 1 && io.g(19, 3) ? units / 10 : units;
}

// G10-G11 in 0.01 % where it is not 0, else G12, which the text gives to manual feed as well (l.5691).
double jogOverride(const nc::gsk::SignalsIo& io) {
  const uint16_t jv = io.gWord(10);
  return jv == 0 ? feedOverride(io) : jv == 0xFFFF ? 0 : jv / 10000.0;
}

} // namespace

void Manual::step(const nc::gsk::SignalsIo& io, Machine& machine, Mode mode) {
  if (mode != mode_) {
    stop(machine);
    mode_ = mode;
  }
  const uint8_t positive = io.gByte(100);
  const uint8_t negative = io.gByte(102);
  if (mode == Mode::Handle)
    for (uint32_t number = 1; number <= 2; ++number) wheel(io, machine, number);
  pulses_ = {};
  for (uint32_t i = 0; i < machine.axes.count(); ++i) {
    if (machine.isPlcAxis(i)) continue;
    const int bit = 1 << i;
    const bool plus = (positive & bit) != 0, minus = (negative & bit) != 0;
    const bool one = plus != minus;
    const bool fresh = plus ? (positiveWas_ & bit) == 0 : (negativeWas_ & bit) == 0;
    if (mode == Mode::Jog && one) {
      jog(io, machine, i, minus);
    } else if (mode == Mode::Zero && one) {
      returnToReference(io, machine, i);
    } else if (mode == Mode::Step && one && fresh && !pending_[i]) {
      pending_[i] = true;
      target_[i] = machine.axes[i].commanded + (minus ? -1 : 1) * increment(io, 1);
    } else if ((mode == Mode::Jog || mode == Mode::Zero) && (driven_ & bit) != 0) {
      machine.axes[i].moving = false;
      machine.axes[i].rest = 0;
      driven_ = static_cast<uint8_t>(driven_ & ~bit);
    }
    if (!pending_[i]) continue;
    driven_ = static_cast<uint8_t>(driven_ | bit);
    pending_[i] = !machine.axes.moveTowards(i, target_[i], unitsPerSlot(machine.tables.parameterReal(kParamRapid, i)));
  }
  positiveWas_ = positive;
  negativeWas_ = negative;
}

void Manual::jog(const nc::gsk::SignalsIo& io, Machine& machine, uint32_t axis, bool negative) {
  const bool rapid = io.g(19, 7); // RT l.4527
  const double speed = rapid ? rapidSpeed(io, machine.tables, axis) : jogSpeed * jogOverride(io);
  if ((driven_ >> axis & 1) == 0) machine.rapid = rapid;
  driven_ = static_cast<uint8_t>(driven_ | 1 << axis);
  const int64_t far = static_cast<int64_t>(unitsPerSlot(speed)) + kIncrement;
  machine.axes.moveTowards(axis, machine.axes[axis].commanded + (negative ? -far : far), unitsPerSlot(speed));
}

// Without blocks (l.5087): straight to the origin while the key is held, whichever direction it names.
void Manual::returnToReference(const nc::gsk::SignalsIo& io, Machine& machine, uint32_t axis) {
  Axis& a = machine.axes[axis];
  if (a.atReference[0]) return;
  if ((driven_ >> axis & 1) == 0) machine.rapid = true;
  driven_ = static_cast<uint8_t>(driven_ | 1 << axis);
  const int64_t target = Axes::reference(machine.tables, axis, 1);
  const double speed = rapidSpeed(io, machine.tables, axis, kParamReturn);
  if (!machine.axes.moveTowards(axis, target, unitsPerSlot(speed))) return;
  if (a.machine == target) machine.axes.arriveAtReference(axis, 1);
}

void Manual::wheel(const nc::gsk::SignalsIo& io, Machine& machine, uint32_t number) {
  const uint8_t selected = number == 1 ? io.gByte(18) & 0xF : io.gByte(18) >> 4; // l.4545-4583
  const int64_t pulses = pulses_[number - 1];
  if (pulses == 0 || selected == 0 || selected > machine.axes.count() || machine.isPlcAxis(selected - 1u)) return;
  const uint32_t axis = selected - 1u;
  if (!pending_[axis]) target_[axis] = machine.axes[axis].commanded;
  pending_[axis] = true;
  target_[axis] += pulses * increment(io, number);
}

void Manual::stop(Machine& machine) {
  for (uint32_t i = 0; i < kAxes; ++i)
    if ((driven_ >> i & 1) != 0) {
      machine.axes[i].moving = false;
      machine.axes[i].rest = 0;
    }
  pending_ = {};
  pulses_ = {};
  driven_ = 0;
}

} // namespace rung::sim::gsk
