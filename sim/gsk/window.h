// The answers of the simulated CNC to window requests (man. §9.3, l.8482-8945), from its tables and axes.
#pragma once
#include "rtlib/nc/gsk/window_functions.h"
#include "sim/gsk/machine.h"

namespace rung::sim::gsk {

struct WindowRequest {
  bool write = false;
  uint32_t function = 0;
  uint32_t length = 0;
  uint32_t number = 0;
  uint32_t attribute = 0;
  int64_t data = 0;
};

struct WindowAnswer {
  nc::gsk::WindowEnd end = nc::gsk::kWindowDone;
  int64_t data = 0;
};

// Highest numbers of this model's tables, where the manual gives none.
inline constexpr uint32_t kToolOffsets = 400;
inline constexpr uint32_t kMaxParameter = 9999;
inline constexpr uint32_t kMaxPitch = 1023;

// `locked`: tables are protected, every write ends with code 7.
WindowAnswer answerWindow(const WindowRequest& request, Machine& machine, const nc::gsk::SignalsIo& io,
                          uint32_t sequence, bool locked);

} // namespace rung::sim::gsk
