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

namespace {

// Waits for the due time of a step, from which the step is measured, however early the thread wakes.
void waitFor(Steps& steps, int64_t dueNs, int64_t earlyNs) noexcept {
  sleepUntil(dueNs - earlyNs);
  if (earlyNs == 0) return;
  steps.prepare(dueNs);
  waitAwake(dueNs);
}

// Each slice of an instance is a step.
class Slices final : public Steps {
public:
  Slices(Instance& instance, const std::function<void()>& slice, const std::function<bool()>& keepGoing)
      : instance_(instance), slice_(slice), keepGoing_(keepGoing) {}

  int64_t dueAfter(int64_t, int64_t nowNs) noexcept override {
    if (stats_.slices == 0) begunNs_ = nowNs;
    return begunNs_ + pace_.untilNextNs();
  }
  void step(int64_t nowNs, int64_t elapsedNs) override {
    begunNs_ = nowNs;
    pace_.elapse(elapsedNs);
    pace_.take();
    slice_();
  }
  void stepped(const Step& step) override {
    ++stats_.slices;
    stats_.missed = pace_.missed();
    stats_.maxLateNs = std::max(stats_.maxLateNs, step.lateNs);
    stats_.maxRunNs = std::max(stats_.maxRunNs, step.tookNs);
  }
  bool ended() override { return stats_.slices != 0 && (instance_.faulted() || !keepGoing_()); }

  const RealTimeStats& stats() const { return stats_; }

private:
  Instance& instance_;
  const std::function<void()>& slice_;
  const std::function<bool()>& keepGoing_;
  Pace pace_{instance_, {.mostOverruns = 0}}; // the user sees the number of missed scans
  int64_t begunNs_ = 0;                       // when the last step began
  RealTimeStats stats_;
};

} // namespace

void runSteps(Steps& steps, int64_t earlyNs) {
  const int64_t begun = monotonicNs();
  int64_t last = begun;
  for (int64_t due = steps.dueAfter(begun, begun); !steps.ended();) {
    waitFor(steps, due, earlyNs);
    const int64_t begin = monotonicNs();
    const int64_t elapsed = begin - std::exchange(last, begin);
    steps.step(begin, elapsed);
    const int64_t end = monotonicNs();
    steps.stepped({.beginNs = begin - begun, .periodNs = elapsed, .lateNs = begin - due, .tookNs = end - begin});
    due = steps.dueAfter(due, end);
  }
}

RealTimeStats runRealTime(Instance& instance, const std::function<void()>& slice,
                          const std::function<bool()>& keepGoing) {
  Slices slices(instance, slice, keepGoing);
  runSteps(slices);
  return slices.stats();
}

} // namespace rung::runtime
