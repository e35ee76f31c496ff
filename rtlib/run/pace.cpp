// Bounded catching up of late scans (see pace.h).
#include "rtlib/run/pace.h"

#include <algorithm>

namespace rung::runtime {

Pace::Pace(Instance& instance, const PaceOptions& options) : instance_(instance), options_(options) {
  programChanged();
}

void Pace::programChanged() noexcept { passUs_ = static_cast<int64_t>(scanPeriodUs(instance_.program())); }

bool Pace::take() noexcept {
  const int64_t lateNs = -untilNextNs();
  if (lateNs < 0 || !hasPeriod() || overloaded_) return false;
  if (instance_.atListStart()) leaveOut(lateNs);
  if (overloaded_) return false;
  lagNs_ -= delayNs();
  return true;
}

void Pace::leaveOut(int64_t lateNs) noexcept {
  const int64_t caughtUp = std::max<int64_t>(options_.catchUp, 1) - 1;
  const int64_t leftOut = std::max<int64_t>(lateNs / (passUs_ * 1000) - caughtUp, 0);
  missed_ += static_cast<uint64_t>(leftOut);
  instance_.advanceClock(leftOut * passUs_);
  lagNs_ -= leftOut * passUs_ * 1000;
  overruns_ = leftOut == 0 ? 0 : overruns_ + 1;
  overloaded_ = options_.mostOverruns != 0 && overruns_ > options_.mostOverruns;
}

} // namespace rung::runtime
