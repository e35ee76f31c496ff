// Attributes of an axis in the control's configuration (man. l.11475-11610). Positions in mm (degrees), speeds in
// mm/min (degrees/min), accelerations in mm/s² (degrees/s²).
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "rtlib/nc/technol/services.h"

namespace rung::io {

// Limit of positions and other numbers of a configuration, in their unit; the range of their cells is much smaller.
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
  double feedOvrDuringRef = 0;   // l.11577: %F changes the speed of a reference: 0 yes, 1 no
  double needRef = 0, autNeedRef = 0;
  double acceleration = 500, accelerationRT = 500, accelerationEmergency = 2000;
  double feed = 2000, feedRT = 60000;
  double rotary = 0;
  double zeroPulsePitch = 0; // 0: 360 for a rotary axis, otherwise 10
  double zeroPulseAt = 0;    // physical position of one pulse
  double position = 0;       // physical position at power-up
  double speedAt10V = 0;     // of the spindle, per minute; 0: it does not turn
  double manEnable = 1;      // signal that permits manual motion: 1 MPxPI, 2 MPxMAN (l.10861-10869)

  double pitch() const { return zeroPulsePitch > 0 ? zeroPulsePitch : rotary != 0 ? kDegreesPerTurn : 10; }
  uint32_t method() const { return static_cast<uint32_t>(refMethod); }
  // Sets an attribute by its name in the control's configuration; case does not matter. Returns "", or the error.
  std::string set(std::string_view name, std::string_view value);
  static bool has(std::string_view name);
};

// A key axis.N.ATTRIBUTE of the configuration.
struct AxisKey {
  uint32_t axis = 0; // from 1
  std::string_view attribute;
};
bool isAxisKey(std::string_view key);
// Returns "", or the error.
std::string readAxisKey(std::string_view key, AxisKey& read);

// Axes of a control are numbered from 1. A mask has one bit per axis: axis n is bit n - 1.

using nc::kMaxAxes;

using AxisMask = uint16_t;

constexpr bool has(AxisMask mask, uint32_t index) { return (mask >> index & 1) != 0; }
constexpr AxisMask bitOf(uint32_t index) { return static_cast<AxisMask>(1u << index); }
constexpr void clearBit(AxisMask& mask, uint32_t index) { mask = static_cast<AxisMask>(mask & ~bitOf(index)); }
constexpr void setBit(AxisMask& mask, uint32_t index) { mask = static_cast<AxisMask>(mask | bitOf(index)); }

// Cells of the program that permit axes to move, as masks. The default values are those after MODULE_INIT.

struct AxisPermits {
  AxisMask enabled = 0xFFFF;              // MPxPI l.6177
  AxisMask limitPlus = 0, limitMinus = 0; // KHx0, KHx1 l.6674
};

// The reason why an axis does not move in a direction.
enum class Hold : uint8_t { None, Disabled, Limit };

constexpr bool atLimit(const AxisPermits& in, uint32_t index, bool negative) {
  return has(negative ? in.limitMinus : in.limitPlus, index);
}
constexpr Hold holdOf(const AxisPermits& in, uint32_t index, bool negative, AxisMask enabled) {
  if (atLimit(in, index, negative)) return Hold::Limit;
  return has(enabled, index) ? Hold::None : Hold::Disabled;
}

// Motions and positions of axes, as their cells report them; only axes that exist have any.

struct AxisReport {
  AxisMask motion = 0;                           // PO_OSxPI
  AxisMask negative = 0;                         // SM_POxPI
  std::array<int64_t, kMaxAxes> positionEx = {}; // B_POL_EX, POSITION_POSk_EX (k < 6): 1/65536 µm
  std::array<int32_t, 6> positionShort = {};     // B_POL: 1/8 µm

  template <class Archive>
  void state(Archive& archive) {
    archive(motion, negative, positionEx, positionShort);
  }

  // Sets the position of axis `index` + 1, in mm (degrees).
  void place(uint32_t index, double position) {
    positionEx[index] = std::llround(position * 1000 * 65536);
    if (index < positionShort.size())
      positionShort[index] = static_cast<int32_t>(std::llround(position * 8000)); // wraps like the cell
  }
};

} // namespace rung::io
