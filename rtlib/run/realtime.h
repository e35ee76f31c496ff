// Runs an instance on the machine's clock: slice by slice, each at its time on CLOCK_MONOTONIC; what comes late is
// caught up (see pace.h).
#pragma once
#include <sched.h>

#include <cstdint>
#include <functional>
#include <string>

#include "rtlib/run/instance.h"

namespace rung::runtime {

int64_t monotonicNs();
void sleepUntil(int64_t ns) noexcept; // of that clock
void waitAwake(int64_t ns) noexcept;  // the same without giving the processor away

struct RealTimeOptions {
  int priority = 0;        // above 0: SCHED_FIFO with this priority, 1 to 99
  bool lockMemory = false; // mlockall of what is there and of what comes
};

// What the thread that makes it asks of the system. The scheduling is put back when the object ends; the process's
// memory stays locked, because whoever else relies on that cannot be known.
class RealTimeThread {
public:
  explicit RealTimeThread(const RealTimeOptions& options);
  ~RealTimeThread();
  RealTimeThread(const RealTimeThread&) = delete;
  RealTimeThread& operator=(const RealTimeThread&) = delete;

  // "" or what the system does not grant, why, and how to get it.
  const std::string& problem() const { return problem_; }

private:
  void raise(int priority);

  std::string problem_;
  sched_param oldParam_{};
  int oldPolicy_ = 0;
  bool raised_ = false;
};

// The calling thread is a helper: it loses the real-time priority that it has inherited from the thread that started
// it, and gets no signals, which are for the thread that waits for them; a pipe whose reader has gone is an error for
// it.
void becomeHelper() noexcept;

struct RealTimeStats {
  uint64_t slices = 0;
  uint64_t missed = 0;   // passes of the schedule that were left out
  int64_t maxLateNs = 0; // from the due time to the start of a slice
  int64_t maxRunNs = 0;
};

// Calls `slice`, which runs one of the instance, whenever one is due: on the calling thread, until `keepGoing`, asked
// after every slice, says no, or a fault stops the program.
RealTimeStats runRealTime(Instance& instance, const std::function<void()>& slice,
                          const std::function<bool()>& keepGoing);

} // namespace rung::runtime
