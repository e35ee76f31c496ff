// An upper bound for the time of a slice on this computer: the weight of its longest path, times the highest measured
// cost of a unit of weight, plus the process-image copies. It does not include cache misses, interruptions and the
// control's hooks in the schedule. Not for real time.
#pragma once
#include <cstdint>
#include <string>

#include "rtlib/run/loaded_program.h"

namespace rung::runtime {

struct ScanBound {
  uint64_t weight = 0;       // of the slice with the least reserve, in steps as budgets count them
  double nsPerWeight = 0;    // of the most expensive code
  uint32_t rung = RUNG_NONE; // where that code begins
  int64_t ns = 0;            // the bound for the slice
  int64_t periodNs = 0;      // until the next one is due; 0: the schedule takes no time
  bool loops = false;        // the path may contain loops, which are counted once: only the budget ends them

  bool fits() const { return periodNs == 0 || ns <= periodNs; }
};

// Measures by running every chunk of the program a few times on separate memory (`runnable.memory` is not used).
ScanBound measureBound(const Runnable& runnable);

// `1.3 ms: 20000 steps of 61 ns at most (rung 3 "title", main.pmc:12), and the period is 1 ms`
std::string boundText(const ScanBound& bound, const rung_program& program);

} // namespace rung::runtime
