// Spindles (see spindles.h).
#include "sim/technol/devices/spindles.h"

namespace rung::sim::technol {

AnalogOutput Spindles::switchTo(Axis& axis, uint32_t number, SpindleRole role) {
  axis.spindle = true;
  return AnalogOutputs::switchTo(number, role);
}

uint32_t Spindles::role(const Axis& axis, uint32_t number) const {
  if (!axis.spindle || isOff(number)) return 0;
  return number == main() ? 1 : number == assistant() ? 2 : 3;
}

void Spindles::drive(Axis& axis, uint32_t number) const {
  if (!axis.spindle) return;
  axis.motion.run(output(number) * axis.attributes.speedAt10V / 60, axis.attributes.acceleration);
  // One that was switched off and does not turn is an axis of the position loop again.
  if (isOff(number) && axis.motion.isAtRest()) axis.spindle = false;
}

} // namespace rung::sim::technol
