// The functions of the FANUC window, which WINDR and WINDW request from the CNC. Used by the compiler to know their
// speed, by the simulated CNC to answer, and by the reference page. The codes are those of path 1; path p adds
// kWindowsOfPath (p - 1), and a code of another path belongs to no function here.
#pragma once
#include "rtlib/nc/pmc/window_functions.h"

namespace rung::nc::fanuc {

// Completion codes. -10 (running) and -1 (busy) are not given: a request waits (F19).
enum WindowEnd : int16_t {
  kWindowDone = 0,
  kWindowNoFunction = 1,
  kWindowBadData = 2,   // wrong data, or the CNC does not have the function
  kWindowBadNumber = 3, // axis or number
  kWindowBadForm = 5,   // the value does not fit
};

inline constexpr uint32_t kWindowsOfPath = 1000;

inline constexpr uint16_t kWindowAllAxes = 0xFFFF; // -1 as an attribute

// In the order of their codes. Functions with the status ClosedInSection exist on machines; the simulated CNC and hosts
// do not have their data and answer with kWindowBadData.
std::span<const pmc::WindowFunction> windowFunctions();

} // namespace rung::nc::fanuc
