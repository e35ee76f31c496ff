// The functions of the GSK25i window, which WINDR and WINDW request from the CNC (man. Table 5-49, l.3203-3239; control
// data l.8686-8945). Used by the compiler to check blocks, by the simulated CNC to answer, and by the reference page.
#pragma once
#include "rtlib/nc/pmc/window_functions.h"

namespace rung::nc::gsk {

// End codes (man. l.8668-8676).
enum WindowEnd : uint16_t {
  kWindowDone = 0,
  kWindowBadFunction = 1,
  kWindowBadLength = 2,
  kWindowBadCount = 3,
  kWindowBadAttribute = 4,
  kWindowBadData = 5,
  kWindowNotProvided = 6,
  kWindowProtected = 7,
};

inline constexpr uint32_t kWindowMaxLength = 4;

// L is 1, 2 or 4 wherever it is given (man. l.8664, and every table of §9.3).
constexpr bool isWindowLength(uint64_t bytes) { return bytes == 1 || bytes == 2 || bytes == 4; }

// In the order of their codes.
std::span<const pmc::WindowFunction> windowFunctions();

} // namespace rung::nc::gsk
