// Manual motion of the simulated CNC: jog, single step, hand wheels, return to the reference point (man. chapters III,
// IV).
#pragma once
#include <array>

#include "sim/gsk/machine.h"
#include "sim/gsk/operation.h"

namespace rung::sim::gsk {

class Manual {
public:
  double jogSpeed = 2000; // mm/min at 100 %; the manual names no parameter

  // Pulses of hand wheel 1 or 2, signed; they move the axis in hand-wheel mode and are lost elsewhere.
  void turnWheel(uint32_t wheel, int64_t pulses) { pulses_[wheel - 1] += pulses; }
  void step(const nc::gsk::SignalsIo& io, Machine& machine, Mode mode);
  void stop(Machine& machine);

private:
  void jog(const nc::gsk::SignalsIo& io, Machine& machine, uint32_t axis, bool negative);
  void wheel(const nc::gsk::SignalsIo& io, Machine& machine, uint32_t number);
  void returnToReference(const nc::gsk::SignalsIo& io, Machine& machine, uint32_t axis);

  std::array<int64_t, 2> pulses_ = {};
  std::array<int64_t, kAxes> target_ = {}; // of steps and wheels, where `pending_`
  std::array<bool, kAxes> pending_ = {};
  uint8_t positiveWas_ = 0;
  uint8_t negativeWas_ = 0;
  uint8_t driven_ = 0; // axes that this part moves
  Mode mode_ = Mode::None;
};

} // namespace rung::sim::gsk
