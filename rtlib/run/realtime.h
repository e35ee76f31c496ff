// The real-time loop on CLOCK_MONOTONIC, for rung-run's scan thread and for a single instance. Late scans of a program
// are caught up or skipped by pace.h.
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

  // What the system does not grant, why, and how to get it; or "".
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

struct Step {
  int64_t beginNs = 0;  // since the loop began
  int64_t periodNs = 0; // since the beginning of the step before
  int64_t lateNs = 0;   // delay after the due time
  int64_t tookNs = 0;
};

// The work that a loop does in steps; all functions are called in the thread of the loop.
class Steps {
public:
  virtual ~Steps() = default;
  // The due time of the next step, after a step that was due at `dueNs` and has ended at `nowNs`; at first both are the
  // beginning of the loop.
  virtual int64_t dueAfter(int64_t dueNs, int64_t nowNs) noexcept = 0;
  // Prepares the step until it is due, if the thread wakes early.
  virtual void prepare(int64_t untilNs) noexcept { (void)untilNs; }
  virtual void step(int64_t nowNs, int64_t elapsedNs) = 0; // since the beginning of the step before
  virtual void stepped(const Step& step) = 0;              // called after each step with its times
  virtual bool ended() = 0;                                // asked before each step; true ends the loop
};

// Runs the loop in the calling thread, which wakes `earlyNs` before a step is due.
void runSteps(Steps& steps, int64_t earlyNs = 0);

struct RealTimeStats {
  uint64_t slices = 0;
  uint64_t missed = 0;   // scans that were skipped
  int64_t maxLateNs = 0; // from the due time to the start of a slice
  int64_t maxRunNs = 0;
};

// Runs the slices of an instance when they are due, in the calling thread: calls `slice`, which runs one, until a fault
// stops the program or `keepGoing`, called after every slice, returns false.
RealTimeStats runRealTime(Instance& instance, const std::function<void()>& slice,
                          const std::function<bool()>& keepGoing);

} // namespace rung::runtime
