// Decides which slices of a program's schedule are due on a clock outside the program, such as the computer's. A late
// scan still runs; of several late scans the host may catch up `catchUp`, and the others are skipped: the program's
// clock advances over them, so its timers stay right. If scans are skipped again and again, the computer is too slow
// for the program. Allocates nothing.
#pragma once
#include <cstdint>

#include "rtlib/run/instance.h"

namespace rung::runtime {

struct PaceOptions {
  uint32_t catchUp = 1;        // late scans that run in succession; 1: only the one that is due
  uint32_t mostOverruns = 500; // successive scans before which others were skipped; 0: any number
};

class Pace {
public:
  // The instance outlives this object.
  explicit Pace(Instance& instance, const PaceOptions& options = {});
  // Another program has taken over in the instance.
  void programChanged() noexcept;
  // Whether the schedule takes time (scanPeriodUs); if not, nothing is ever due.
  bool hasPeriod() const noexcept { return passUs_ > 0; }

  // The outside clock has advanced by `ns`.
  void elapse(int64_t ns) noexcept { lagNs_ += ns; }
  // The time until the next slice is due; 0 or less: it has been due for so long.
  int64_t untilNextNs() const noexcept { return delayNs() - lagNs_; }
  // True: the next slice is due, and the caller must run it now. If a scan begins with it, scans may be skipped here.
  bool take() noexcept;
  // Scans were skipped more than mostOverruns times in succession: nothing is due any more, until `restart`.
  bool overloaded() const noexcept { return overloaded_; }
  // The program begins anew, and is not late.
  void restart() noexcept {
    lagNs_ = 0;
    overruns_ = 0;
    overloaded_ = false;
  }

  // The number of scans that were skipped.
  uint64_t missed() const noexcept { return missed_; }

private:
  int64_t delayNs() const noexcept { return int64_t{instance_.sliceDelayUs()} * 1000; }

  void leaveOut(int64_t lateNs) noexcept;

  Instance& instance_;
  PaceOptions options_;
  uint32_t overruns_ = 0; // in succession
  bool overloaded_ = false;
  int64_t passUs_ = 0;
  int64_t lagNs_ = 0; // how late the program's clock is
  uint64_t missed_ = 0;
};

} // namespace rung::runtime
