// The periodic loop on CLOCK_MONOTONIC.
#include "rtlib/host/realtime.h"

#include <pthread.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>

namespace rung::host {

namespace {

constexpr int64_t kNsPerSecond = 1'000'000'000;

void sleepUntil(int64_t ns) {
  const timespec due = {static_cast<time_t>(ns / kNsPerSecond), static_cast<long>(ns % kNsPerSecond)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) == EINTR) {
  }
}

} // namespace

RealTimeThread::RealTimeThread(const RealTimeOptions& options) {
  if (options.priority > 0) raise(options.priority);
  if (!problem_.empty() || !options.lockMemory || mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return;
  problem_ = std::string("memory cannot be locked: ") + std::strerror(errno) +
             "; raise the limit of locked memory (ulimit -l), or run with CAP_IPC_LOCK";
}

RealTimeThread::~RealTimeThread() {
  if (raised_) pthread_setschedparam(pthread_self(), oldPolicy_, &oldParam_);
}

void RealTimeThread::raise(int priority) {
  sched_param param{};
  param.sched_priority = priority;
  int wrong = pthread_getschedparam(pthread_self(), &oldPolicy_, &oldParam_);
  if (wrong == 0) wrong = pthread_setschedparam(pthread_self(), SCHED_FIFO, &param);
  raised_ = wrong == 0;
  if (raised_) return;
  problem_ = "real-time priority " + std::to_string(priority) + ": " + std::strerror(wrong) +
             "; raise the limit of real-time priorities (ulimit -r), or run with CAP_SYS_NICE";
}

int64_t monotonicNs() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return int64_t{now.tv_sec} * kNsPerSecond + now.tv_nsec;
}

RealTimeStats runRealTime(Instance& instance, const std::function<bool()>& keepGoing) {
  RealTimeStats stats;
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
