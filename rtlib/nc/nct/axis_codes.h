// The instruction codes of MOVCMND (man. §6.15, l.3126-3145). Used by the compiler for checks, by the simulated NC for
// motions, and by the reference page.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace rung::nc::nct {

inline constexpr uint32_t kAxes = 32; // the axis is given by its index, 0 to 31 (l.3082)

enum class AxisSpeed : uint8_t {
  Unused,
  PerMinute,
  PerRevolution,
  Jog, // per minute; 0: parameter N0316 Jog F Contr
};
enum class AxisDistance : uint8_t {
  Unused,
  Absolute, // in the current coordinate system
  Incremental,
  Machine, // absolute in the machine coordinate system
  Seconds,
  Revolutions,
};

struct AxisCode {
  uint8_t code = 0;
  std::string_view equivalent; // NC code
  std::string_view title;
  AxisSpeed speed = AxisSpeed::Unused;
  AxisDistance distance = AxisDistance::Unused;
  uint16_t line = 0;
  // The instruction refuses speed 0 (l.3122).
  constexpr bool needsSpeed() const { return speed == AxisSpeed::PerMinute || speed == AxisSpeed::PerRevolution; }
};

// Code n is element n.
std::span<const AxisCode> axisCodes();

} // namespace rung::nc::nct
