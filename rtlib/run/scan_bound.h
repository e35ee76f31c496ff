// How long a slice of a program may last on this machine: the weight of its longest way, times the most that a unit of
// weight was found to cost here, and the copies at its borders. Waits for memory and interruptions come on top, as does
// what the NC's part of the schedule runs by itself. Outside real time.
#pragma once
#include <cstdint>
#include <string>

#include "rtlib/run/loaded_program.h"

namespace rung::runtime {

struct ScanBound {
  uint64_t weight = 0;       // of the slice that comes nearest to its period, in steps as budgets count them
  double nsPerWeight = 0;    // of the dearest piece of code
  uint32_t rung = RUNG_NONE; // where that piece begins
  int64_t ns = 0;            // that the slice may last
  int64_t periodNs = 0;      // until the next one is due; 0: the schedule takes no time
  bool loops = false;        // control may go in loops, which are counted once: the budget alone ends them

  bool fits() const { return periodNs == 0 || ns <= periodNs; }
};

// Runs every chunk of the program a few times, on memory of its own (`runnable.memory` is not used).
ScanBound measureBound(const Runnable& runnable);

// `1.3 ms: 20000 steps of 61 ns at most (rung 3 "title", main.pmc:12), and the period is 1 ms`
std::string boundText(const ScanBound& bound, const rung_program& program);

} // namespace rung::runtime
