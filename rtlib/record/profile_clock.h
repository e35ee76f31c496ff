// The calibrated clock of instrumented programs.
#pragma once

namespace rung::runtime {

struct ProfileClock {
  double nsPerTick = 1; // ticks of the counter in rtlib/core/ticks.h
  double costTicks = 0; // measured time of an empty rung, included in every execution
  double costNs() const { return nsPerTick * costTicks; }
};

// Calibrates against CLOCK_MONOTONIC, once per process (about 10 ms).
const ProfileClock& calibratedClock();

} // namespace rung::runtime
