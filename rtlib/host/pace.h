// What is due of a program's schedule on a clock that runs beside the program's. Slices that are late run one after the
// other until the program has caught up, for as many as kMostLate passes; of more, whole passes are left out: the
// program's clock is moved over them, so timers stay right. Nothing allocates.
#pragma once
#include <cstdint>

#include "rtlib/host/instance.h"

namespace rung::host {

class Pace {
public:
  static constexpr int64_t kMostLate = 10; // passes

  // The instance outlives it.
  explicit Pace(Instance& instance);
  // Another program has taken over.
  void programChanged() noexcept;
  // The schedule takes time (scanPeriodUs); without it nothing is ever due.
  bool hasPeriod() const noexcept { return passUs_ > 0; }

  // The other clock has advanced by `ns`.
  void elapse(int64_t ns) noexcept { lagNs_ += ns; }
  // The time until the next slice is due; 0 and less: it is, for so long.
  int64_t untilNextNs() const noexcept { return delayNs() - lagNs_; }
  // True: the next slice is due, and the caller runs it now. Where a pass begins with it, passes may be left out.
  bool take() noexcept;
  // The program begins anew, in time.
  void restart() noexcept { lagNs_ = 0; }

  // Passes that were left out.
  uint64_t missed() const noexcept { return missed_; }

private:
  int64_t delayNs() const noexcept { return int64_t{instance_.sliceDelayUs()} * 1000; }

  Instance& instance_;
  int64_t passUs_ = 0;
  int64_t lagNs_ = 0; // of the program's clock
  uint64_t missed_ = 0;
};

} // namespace rung::host
