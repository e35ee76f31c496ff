// The calibrated clock of instrumented programs.
#pragma once

namespace rung::runtime {

struct ProfileClock {
  double nsPerTick = 1; // of the counter in rtlib/core/ticks.h
  double costTicks = 0; // what an empty rung measures: it is part of every execution
  double costNs() const { return nsPerTick * costTicks; }
};

// Calibrates against CLOCK_MONOTONIC, once per process (about 10 ms).
const ProfileClock& calibratedClock();

} // namespace rung::runtime
