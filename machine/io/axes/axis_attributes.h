// What the configuration of the control says of an axis (man. l.11475-11610). Places in mm (degrees), speeds in mm/min
// (degrees/min), accelerations in mm/s² (degrees/s²).
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace rung::io {

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

// A key axis.N.ATTRIBUTE of the configuration.
struct AxisKey {
  uint32_t axis = 0; // from 1
  std::string_view attribute;
};
bool isAxisKey(std::string_view key);
// "" or what is wrong.
std::string readAxisKey(std::string_view key, AxisKey& read);

} // namespace rung::io
