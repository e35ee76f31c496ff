// One axis of the simulated machine: its configuration, where it is physically and what it measures, its zero pulses,
// and who moves it. Places in mm (degrees), speeds in mm/min (degrees/min), accelerations in mm/s² (degrees/s²).
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "tools/sim/technol/devices/motion.h"

namespace rung::sim::technol {

inline constexpr uint32_t kMaxAxes = 16;
// Of places and other numbers of a configuration, in their unit: their cells hold much less.
inline constexpr double kFarthest = 1e9;
inline constexpr double kDegreesPerTurn = 360;

// Attributes of the element NCAxis (man. l.11475-11610), and those of the simulated machine.
struct AxisAttributes {
  double refMethod = 9;          // l.11475: 1, 5, 9-15
  double refViaPlc = 0;          // l.11497
  double refSwitch = 1;          // l.11507: 0 not tested, 1 edge, 2 level
  double slowDownSwitch = 0;     // l.11516
  double invertRefDirection = 0; // l.11525: 1 in negative direction
  double refSpeed = 10000;       // l.11534
  double refSpeedLow = 50;       // l.11540
  double moveToPosAfterRef = 0;  // l.11555: 1 relative, 2 absolute
  double posAfterRef = 0;        // l.11561
  double machineNullPoint = 0;   // l.11567
  double feedOvrDuringRef = 0;   // l.11577: 0 %F has an effect on the speed of a reference, 1 it has none
  double needRef = 0, autNeedRef = 0;
  double acceleration = 500, accelerationRT = 500, accelerationEmergency = 2000;
  double feed = 2000, feedRT = 60000;
  double rotary = 0;
  double zeroPulsePitch = 0; // 0: 360 of a rotary axis, else 10
  double zeroPulseAt = 0;    // physical place of one pulse
  double position = 0;       // physical place at power-up
  double speedAt10V = 0;     // of the spindle, per minute; 0: it does not turn
  double manEnable = 1;      // 1 MPxPI, 2 MPxMAN allows manual motion (l.10861-10869)

  double pitch() const { return zeroPulsePitch > 0 ? zeroPulsePitch : rotary != 0 ? kDegreesPerTurn : 10; }
  uint32_t method() const { return static_cast<uint32_t>(refMethod); }
  // By its name in the control's configuration, in any case. "" or what is wrong.
  std::string set(std::string_view name, std::string_view value);
  static bool has(std::string_view name);
};

enum class Mover : uint8_t { None, SpindlePositioning, PositioningUnit, Reference, Manual };

class Axis {
public:
  AxisAttributes attributes;
  Motion motion; // its place is the physical one without the shift
  Motion shift;  // SHIFT (l.11057): added to the path after the interpolator, not measured
  Mover mover = Mover::None;
  bool spindle = false;   // speed loop, from AX_SPI to SPI_AX
  bool requested = false; // PO_OSxPI: a motion is wanted, also where it is not allowed (l.6243-6250)
  bool negative = false;  // SM_POxPI: direction of that motion

  // At power-up: at its place, measuring 0.
  void reset();
  double physical() const { return motion.position() + shift.position(); }
  double measured() const { return motion.position() + offset_; }
  double speedPerMinute() const { return (motion.speed() + shift.speed()) * 60; }
  bool moves() const { return !motion.standing() || !shift.standing(); }
  // The place where it is has this measure.
  void setMeasured(double value) { offset_ = value - motion.position(); }
  // Puts it there, physically and measured.
  void setPhysical(double place);
  // The place of `motion` with this measure.
  double placeOf(double measure) const { return measure - offset_; }

  void request(bool inNegative) {
    requested = true;
    negative = inNegative;
  }
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
