// Runs an instance on the computer's clock: each slice at its time on CLOCK_MONOTONIC. Late slices are caught up as
// pace.h says.
#pragma once
#include <sched.h>

#include <cstdint>
#include <functional>
#include <string>

#include "rtlib/run/instance.h"

namespace rung::runtime {

int64_t monotonicNs();
void sleepUntil(int64_t ns) noexcept; // CLOCK_MONOTONIC
void waitAwake(int64_t ns) noexcept;  // the same by busy waiting

struct RealTimeOptions {
  int priority = 0;        // above 0: SCHED_FIFO with this priority, 1 to 99
  bool lockMemory = false; // mlockall of all present and future memory
};

// Real-time scheduling and locked memory for the thread that creates this object. The destructor restores the
// scheduling; the process's memory stays locked, because other code may rely on it.
class RealTimeThread {
public:
  explicit RealTimeThread(const RealTimeOptions& options);
  ~RealTimeThread();
  RealTimeThread(const RealTimeThread&) = delete;
  RealTimeThread& operator=(const RealTimeThread&) = delete;

  // "", or what the system does not grant, why, and how to get it.
  const std::string& problem() const { return problem_; }

private:
  void raise(int priority);

  std::string problem_;
  sched_param oldParam_{};
  int oldPolicy_ = 0;
  bool raised_ = false;
};

// Makes the calling thread a helper: it loses the real-time priority inherited from the thread that started it,
// receives no signals (those are for the thread that waits for them), and gets an error instead of SIGPIPE when it
// writes to a closed pipe.
void becomeHelper() noexcept;

struct RealTimeStats {
  uint64_t slices = 0;
  uint64_t missed = 0;   // scans that were skipped
  int64_t maxLateNs = 0; // from the due time to the start of a slice
  int64_t maxRunNs = 0;
};

// Calls `slice`, which runs a slice of the instance, whenever one is due, on the calling thread, until `keepGoing`
// (asked after every slice) returns false or a fault stops the program.
RealTimeStats runRealTime(Instance& instance, const std::function<void()>& slice,
                          const std::function<bool()>& keepGoing);

} // namespace rung::runtime
