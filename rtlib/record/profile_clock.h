// The clock that instrumented programs measure with, calibrated.
#pragma once

namespace rung::runtime {

struct ProfileClock {
  double nsPerTick = 1; // of the counter in rtlib/core/ticks.h
  double costTicks = 0; // what an empty rung measures: it is part of every execution
  double costNs() const { return nsPerTick * costTicks; }
};

// Measured against CLOCK_MONOTONIC once a process (about 10 ms).
const ProfileClock& calibratedClock();

} // namespace rung::runtime
