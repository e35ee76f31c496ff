// Calibration (see profile_clock.h).
#include "rtlib/record/profile_clock.h"

#include "rtlib/core/ticks.h"
#include "rtlib/record/histogram.h"
#include "rtlib/run/realtime.h"
#include "rung/program.h"

namespace rung::runtime {
namespace {

double nsPerTick() {
  constexpr int64_t kMeasureNs = 10'000'000;
  const int64_t startNs = monotonicNs();
  const uint64_t startTicks = core::readTicks();
  int64_t endNs = startNs;
  while (endNs - startNs < kMeasureNs) endNs = monotonicNs();
  const uint64_t ticks = core::readTicks() - startTicks;
  return ticks == 0 ? 1.0 : static_cast<double>(endNs - startNs) / static_cast<double>(ticks);
}

// The measuring code of a rung without operations.
void measureNothing(volatile rung_prof& prof) {
  prof.started = core::readTicks();
  const uint64_t ticks = core::readTicks() - prof.started;
  prof.count = prof.count + 1;
  prof.total = prof.total + ticks;
  prof.max = ticks;
}

double emptyRungTicks() {
  constexpr int kRungs = 20'000;
  Histogram ticks;
  rung_prof prof{};
  for (int i = 0; i < kRungs; ++i) {
    measureNothing(prof);
    ticks.add(prof.max);
  }
  return ticks.trimmedMean();
}

} // namespace

const ProfileClock& calibratedClock() {
  static const ProfileClock calibrated = {nsPerTick(), emptyRungTicks()};
  return calibrated;
}

} // namespace rung::runtime
