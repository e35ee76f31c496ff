// One axis of the simulated machine: its configuration, where it is physically and what it measures, its zero pulses,
// and who moves it. Places in mm (degrees), speeds in mm/min (degrees/min), accelerations in mm/s² (degrees/s²).
#pragma once
#include <cstdint>

#include "machine/io/axes/axis_mask.h"
#include "machine/io/axes/driven_axis.h"

namespace rung::sim::technol {

using io::AxisAttributes;
using io::kDegreesPerTurn;
using io::kFarthest;
using io::kMaxAxes;
using io::Motion;
using io::Mover;

// The place of `motion` is the physical one without the shift.
class Axis : public io::DrivenAxis {
public:
  Motion shift;         // SHIFT (l.11057): added to the path after the interpolator, not measured
  bool spindle = false; // speed loop, from AX_SPI to SPI_AX

  // At power-up: at its place, measuring 0.
  void reset();
  double physical() const { return motion.position() + shift.position(); }
  double measured() const { return motion.position() + offset_; }
  double speedPerMinute() const { return (motion.speed() + shift.speed()) * 60; }
  bool moves() const { return !motion.isAtRest() || !shift.isAtRest(); }
  // The place where it is has this measure.
  void setMeasured(double value) { offset_ = value - motion.position(); }
  // Puts it there, physically and measured.
  void setPhysical(double place);
  // The place of `motion` with this measure.
  double placeOf(double measure) const { return measure - offset_; }

  // Its mover leaves it: it brakes to a standstill, until which its motion is reported.
  void letGo(double acceleration);
  void tick();

  // Runs in the direction of the signed speed (per minute) past the next zero pulse and brakes from there. A pulse
  // counts from where the speed is at most that and has the right direction.
  void seekPulse(double perMinute, double acceleration);
  // It has passed the pulse, which thereby has the measure `value`.
  bool passedPulse(double value);
  void forgetPulse() { seeks_ = false; }
  double pulse() const { return pulse_; } // the place of `motion` of the last one

private:
  double nextPulse(double from, bool downwards) const;

  double offset_ = 0;
  bool seeks_ = false, seeksDownwards_ = false;
  double pulse_ = 0;
};

} // namespace rung::sim::technol
