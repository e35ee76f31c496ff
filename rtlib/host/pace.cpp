// The bound on what a program catches up (see pace.h).
#include "rtlib/host/pace.h"

#include <algorithm>

namespace rung::host {

Pace::Pace(Instance& instance) : instance_(instance) { programChanged(); }

void Pace::programChanged() noexcept { passUs_ = static_cast<int64_t>(scanPeriodUs(instance_.program())); }

bool Pace::take() noexcept {
  const int64_t lateNs = -untilNextNs();
  if (lateNs < 0 || !hasPeriod()) return false;
  if (instance_.atListStart()) {
    const int64_t leftOut = std::max<int64_t>(lateNs / (passUs_ * 1000) - kMostLate, 0);
    missed_ += static_cast<uint64_t>(leftOut);
    instance_.advanceClock(leftOut * passUs_);
    lagNs_ -= leftOut * passUs_ * 1000;
  }
  lagNs_ -= delayNs();
  return true;
}

} // namespace rung::host
