// What is due of a program's schedule on a clock that runs beside the program's. A pass that is late runs; of more,
// which the host may have caught up, whole passes are left out: the program's clock is moved over them, so timers stay
// right. A machine that leaves out some again and again is too slow for the program. Nothing allocates.
#pragma once
#include <cstdint>

#include "rtlib/run/instance.h"

namespace rung::runtime {

struct PaceOptions {
  uint32_t catchUp = 1;        // passes that run one after the other where time is lost; 1: the one that is due
  uint32_t mostOverruns = 500; // passes in a row that begin where others are left out; 0: any number
};

class Pace {
public:
  // The instance outlives it.
  explicit Pace(Instance& instance, const PaceOptions& options = {});
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
  // More than mostOverruns: nothing is due any more, until `restart`.
  bool overloaded() const noexcept { return overloaded_; }
  // The program begins anew, in time.
  void restart() noexcept {
    lagNs_ = 0;
    overruns_ = 0;
    overloaded_ = false;
  }

  // Passes that were left out.
  uint64_t missed() const noexcept { return missed_; }

private:
  int64_t delayNs() const noexcept { return int64_t{instance_.sliceDelayUs()} * 1000; }

  void leaveOut(int64_t lateNs) noexcept;

  Instance& instance_;
  PaceOptions options_;
  uint32_t overruns_ = 0; // in a row
  bool overloaded_ = false;
  int64_t passUs_ = 0;
  int64_t lagNs_ = 0; // of the program's clock
  uint64_t missed_ = 0;
};

} // namespace rung::runtime
