// The periodic loop on CLOCK_MONOTONIC.
#include "rtlib/run/realtime.h"

#include <pthread.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <utility>

#include "rtlib/run/pace.h"

namespace rung::runtime {

namespace {
constexpr int64_t kNsPerSecond = 1'000'000'000;
}

void sleepUntil(int64_t ns) noexcept {
  const timespec due = {static_cast<time_t>(ns / kNsPerSecond), static_cast<long>(ns % kNsPerSecond)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) == EINTR) {
  }
}

void waitAwake(int64_t ns) noexcept {
  while (monotonicNs() < ns) {
  }
}

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

void becomeHelper() noexcept {
  const sched_param none{};
  pthread_setschedparam(pthread_self(), SCHED_OTHER, &none);
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

RealTimeStats runRealTime(Instance& instance, const std::function<void()>& slice,
                          const std::function<bool()>& keepGoing) {
  RealTimeStats stats;
  Pace pace(instance, {.mostOverruns = 0}); // a person sees how many were missed
  int64_t now = monotonicNs();
  const auto look = [&] {
    const int64_t before = std::exchange(now, monotonicNs());
    pace.elapse(now - before);
  };
  do {
    if (pace.untilNextNs() > 0) sleepUntil(now + pace.untilNextNs());
    look();
    stats.maxLateNs = std::max(stats.maxLateNs, -pace.untilNextNs());
    pace.take();
    slice();
    ++stats.slices;
    const int64_t start = now;
    look();
    stats.maxRunNs = std::max(stats.maxRunNs, now - start);
  } while (!instance.faulted() && keepGoing());
  stats.missed = pace.missed();
  return stats;
}

} // namespace rung::runtime
