// Analogue outputs and spindles (see spindles.h).
#include "tools/sim/technol/devices/spindles.h"

#include <algorithm>

namespace rung::sim::technol {

AnalogOutput Spindles::putOn(uint32_t port, int64_t value) {
  if (port == 0) return {};
  outputs_[port - 1] = static_cast<double>(std::clamp<int64_t>(value, -kFullOutput, kFullOutput));
  return {port, output(port)};
}

AnalogOutput Spindles::putOnSpindle(int64_t value, uint32_t axis, uint32_t spi) {
  if (spi == 1) return putOn(main_, value);
  if (spi == 2) return putOn(assistant_, value);
  return putOn(lastSwitched_ != 0 ? lastSwitched_ : axis, value);
}

AnalogOutput Spindles::switchTo(Axis& axis, uint32_t number, SpindleRole role) {
  axis.spindle = true;
  lastSwitched_ = number;
  off_ &= ~(1u << (number - 1));
  if (role == SpindleRole::Keep) return {};
  if (main_ == number) main_ = 0;
  if (assistant_ == number) assistant_ = 0;
  if (role == SpindleRole::Main) main_ = number;
  if (role == SpindleRole::Assistant) assistant_ = number;
  if (role != SpindleRole::Off) return {};
  off_ |= 1u << (number - 1);
  return putOn(number, 0);
}

void Spindles::makeMain(uint32_t axis) {
  main_ = axis;
  if (assistant_ == axis) assistant_ = 0;
}

void Spindles::leave(uint32_t axis) {
  if (main_ == axis) main_ = 0;
  if (assistant_ == axis) assistant_ = 0;
  off_ &= ~(1u << (axis - 1));
}

uint32_t Spindles::role(const Axis& axis, uint32_t number) const {
  if (!axis.spindle || isOff(number)) return 0;
  return number == main_ ? 1 : number == assistant_ ? 2 : 3;
}

void Spindles::drive(Axis& axis, uint32_t number) const {
  if (!axis.spindle) return;
  axis.motion.run(output(number) * axis.attributes.speedAt10V / 60, axis.attributes.acceleration);
  // One that was switched off and does not turn is an axis of the position loop again.
  if (isOff(number) && axis.motion.standing()) axis.spindle = false;
}

} // namespace rung::sim::technol
