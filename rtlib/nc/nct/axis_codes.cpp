// The list of instruction codes (see axis_codes.h).
#include "rtlib/nc/nct/axis_codes.h"

#include <iterator>

namespace rung::nc::nct {
namespace {

using D = AxisDistance;
using S = AxisSpeed;

// Code 6 is printed with a position "in the actual coordinate system" beside "positioning in the machine coordinate
// system" and G53 (l.3135): machine coordinates.
constexpr AxisCode kCodes[] = {
    {0, "G00 G90", "rapid positioning", S::Unused, D::Absolute, 3129},
    {1, "G00 G91", "rapid positioning", S::Unused, D::Incremental, 3130},
    {2, "G01 G90 G94", "linear interpolation", S::PerMinute, D::Absolute, 3131},
    {3, "G01 G91 G94", "linear interpolation", S::PerMinute, D::Incremental, 3132},
    {4, "G01 G90 G95", "linear interpolation", S::PerRevolution, D::Absolute, 3133},
    {5, "G01 G91 G95", "linear interpolation", S::PerRevolution, D::Incremental, 3134},
    {6, "G53", "positioning in machine coordinates", S::Unused, D::Machine, 3135},
    {7, "G28", "automatic reference point return", S::Unused, D::Unused, 3136},
    {8, "G30 P2", "return to reference point 2", S::Unused, D::Unused, 3139},
    {9, "G30 P3", "return to reference point 3", S::Unused, D::Unused, 3140},
    {10, "G30 P4", "return to reference point 4", S::Unused, D::Unused, 3141},
    {11, "G4 G94", "dwell", S::Unused, D::Seconds, 3142},
    {12, "G4 G95", "dwell", S::Unused, D::Revolutions, 3143},
    {13, "JOG", "jog movement by AP_JOGP and AP_JOGN, until the next command or AP_RES", S::Jog, D::Unused, 3144},
    {14, "handwheel", "handwheel movement, until the next command or AP_RES", S::Unused, D::Unused, 3145},
};

constexpr bool isSound() {
  for (size_t i = 0; i < std::size(kCodes); ++i)
    if (kCodes[i].code != i || kCodes[i].line == 0) return false;
  return true;
}
static_assert(isSound(), "element n is code n");

} // namespace

std::span<const AxisCode> axisCodes() { return kCodes; }

} // namespace rung::nc::nct
