// The periodic loop on CLOCK_MONOTONIC.
#include "rtlib/host/realtime.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

namespace rung::host {

namespace {

constexpr int64_t kNsPerSecond = 1'000'000'000;

void sleepUntil(int64_t ns) {
  const timespec due = {static_cast<time_t>(ns / kNsPerSecond), static_cast<long>(ns % kNsPerSecond)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) == EINTR) {
  }
}

// The thread's scheduling while the loop runs, put back afterwards. Memory stays locked: a lock is the process's, and
// whoever else relies on one cannot be known.
class Scheduling {
public:
  Scheduling(const RealTimeOptions& options, RealTimeStats& stats) {
    if (options.priority > 0 && pthread_getschedparam(pthread_self(), &oldPolicy_, &oldParam_) == 0) {
      sched_param param{};
      param.sched_priority = options.priority;
      raised_ = pthread_setschedparam(pthread_self(), SCHED_FIFO, &param) == 0;
    }
    stats.priorityGranted = raised_;
    if (options.lockMemory) stats.memoryLocked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  }
  ~Scheduling() {
    if (raised_) pthread_setschedparam(pthread_self(), oldPolicy_, &oldParam_);
  }
  Scheduling(const Scheduling&) = delete;
  Scheduling& operator=(const Scheduling&) = delete;

private:
  int oldPolicy_ = 0;
  sched_param oldParam_{};
  bool raised_ = false;
};

} // namespace

int64_t monotonicNs() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return int64_t{now.tv_sec} * kNsPerSecond + now.tv_nsec;
}

RealTimeStats runRealTime(Instance& instance, const RealTimeOptions& options, const std::function<bool()>& keepGoing) {
  RealTimeStats stats;
  const Scheduling scheduling(options, stats);
  // Monotonic time at which the program's clock would be 0.
  const int64_t origin = monotonicNs() - instance.nowUs() * 1000;
  do {
    const int64_t delayUs = instance.sliceDelayUs();
    const int64_t due = origin + (instance.nowUs() + delayUs) * 1000;
    if (delayUs > 0) sleepUntil(due);
    const int64_t start = monotonicNs();
    stats.maxLateNs = std::max(stats.maxLateNs, start - due);
    if (delayUs > 0 && start - due >= delayUs * 1000) {
      const int64_t missed = (start - due) / (delayUs * 1000);
      stats.missed += static_cast<uint64_t>(missed);
      instance.advanceClock(missed * delayUs);
    }
    instance.slice();
    ++stats.slices;
    stats.maxRunNs = std::max(stats.maxRunNs, monotonicNs() - start);
  } while (!instance.faulted() && keepGoing());
  return stats;
}

} // namespace rung::host
