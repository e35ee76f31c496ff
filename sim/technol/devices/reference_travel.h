// The travel of one axis to its reference point, by its RefMethod (man. l.11612-11662, l.11792-11941).
#pragma once
#include <cstdint>

#include "sim/technol/devices/axis_cells.h"

namespace rung::sim::technol {

// Of a RefMethod: the axis goes to a switch or a mark, with REFPI on (l.6757, l.11798-11887). The others set the zero
// point without a travel.
bool isActualTravel(uint32_t method);

class ReferenceTravel {
public:
  bool active() const { return phase_ != Phase::None; }
  // Not for RefMethod 1, which the program does.
  void begin(Axis& axis);
  // The axis brakes.
  void end(Axis& axis, double acceleration);
  // A millisecond: before the axis moves, and after; that says whether the travel is done.
  void drive(Axis& axis, uint32_t index, const AxisInputs& in);
  bool look(Axis& axis);

private:
  enum class Phase : uint8_t {
    None,
    Seek,    // towards the switch and the zero pulse
    Leave,   // reversed: until the switch falls
    Overrun, // the zero point is known, the axis brakes
    Further, // MoveToPosAfterRef
  };
  void observe(Axis& axis, uint32_t index, const AxisInputs& in);
  void observeZeroPulse(const AxisAttributes& own, uint32_t index, const AxisInputs& in);
  void observeSwitch(Axis& axis, bool on);
  void zeroHere(Axis& axis, double value);
  void move(Axis& axis, const AxisInputs& in) const;
  double target(const Axis& axis) const;

  Phase phase_ = Phase::None;
  bool fresh_ = false; // the edge of a switch needs a look before it
  bool negative_ = false, reversed_ = false;
  bool low_ = false;   // RefSpeedLow from now on
  bool armed_ = false; // zero pulses count
  bool switchWas_ = false;
  double from_ = 0; // of coded distances
};

} // namespace rung::sim::technol
