// Where a timer of a program is: its tables say where its time, its preset and their units are (rung_timer).
#pragma once
#include <cstdint>

#include "rtlib/core/memory.h"
#include "rung/program.h"

namespace rung::runtime {

// Times in microseconds, or runs of the instruction (RUNG_TIMER_RUNS).
struct TimerState {
  bool running = false;
  // Negative: not known.
  int64_t elapsed = 0;   // 0 if it does not run
  int64_t remaining = 0; // the same
  int64_t preset = -1;
};

// Real time. The program has passed checkProgram.
TimerState stateOf(const core::Memory& memory, const rung_timer& timer) noexcept;

} // namespace rung::runtime
