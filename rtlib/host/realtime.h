// Runs an instance on the machine's clock: slice by slice, each at its time on CLOCK_MONOTONIC. A slice that comes late
// by more than its own period is counted as missed periods; the program's clock is moved over them, so timers stay
// right.
#pragma once
#include <cstdint>
#include <functional>

#include "rtlib/host/instance.h"

namespace rung::host {

int64_t monotonicNs();

struct RealTimeOptions {
  int priority = 0;        // above 0: SCHED_FIFO with this priority, when the system grants it
  bool lockMemory = false; // mlockall, when the system grants it; the process's memory stays locked afterwards
};

struct RealTimeStats {
  uint64_t slices = 0;
  uint64_t missed = 0;   // periods that were left out
  int64_t maxLateNs = 0; // from the due time to the start of a slice
  int64_t maxRunNs = 0;
  bool priorityGranted = false;
  bool memoryLocked = false;
};

// Runs on the calling thread until `keepGoing`, asked after every slice, says no, or a fault stops the program.
RealTimeStats runRealTime(Instance& instance, const RealTimeOptions& options, const std::function<bool()>& keepGoing);

} // namespace rung::host
