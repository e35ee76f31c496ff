// A monotonic clock that a test sets, for the thread that does so: sleeping until a time makes it that time. For one
// source of a test program: it defines clock_gettime and clock_nanosleep. Other threads, other clocks and a thread
// without a FakeClock have the machine's.
#pragma once
#include <dlfcn.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <ctime>

namespace {

class FakeClock;
thread_local FakeClock* fakeClock = nullptr;

class FakeClock {
public:
  explicit FakeClock(int64_t ns = 0) : ns_(ns) { fakeClock = this; }
  ~FakeClock() { fakeClock = nullptr; }
  FakeClock(const FakeClock&) = delete;
  FakeClock& operator=(const FakeClock&) = delete;

  int64_t ns() const { return ns_; }
  void advance(int64_t ns) { ns_ += ns; }
  // How much later than asked for the next sleeps end.
  void setLateness(int64_t ns) { lateNs_ = ns; }

  void sleepUntil(const timespec& due) {
    const int64_t end = int64_t{due.tv_sec} * kNsPerSecond + due.tv_nsec + lateNs_;
    if (end > ns_) ns_ = end;
    ++sleeps_;
  }
  int64_t sleeps() const { return sleeps_; }
  timespec now() const { return {static_cast<time_t>(ns_ / kNsPerSecond), static_cast<long>(ns_ % kNsPerSecond)}; }

private:
  static constexpr int64_t kNsPerSecond = 1'000'000'000;
  int64_t ns_;
  int64_t lateNs_ = 0;
  int64_t sleeps_ = 0;
};

using ReadClock = int (*)(clockid_t, timespec*);
using SleepOnClock = int (*)(clockid_t, int, const timespec*, timespec*);

// The C library's, which reads most clocks without a system call; found before the tests begin.
const auto kRealReadClock = reinterpret_cast<ReadClock>(dlsym(RTLD_NEXT, "clock_gettime"));
const auto kRealSleepOnClock = reinterpret_cast<SleepOnClock>(dlsym(RTLD_NEXT, "clock_nanosleep"));

} // namespace

// NOLINTBEGIN(misc-definitions-in-headers): for one source, as said above
extern "C" int clock_gettime(clockid_t clock, timespec* time) {
  if (fakeClock != nullptr && clock == CLOCK_MONOTONIC) return *time = fakeClock->now(), 0;
  if (kRealReadClock != nullptr) return kRealReadClock(clock, time);
  return static_cast<int>(syscall(SYS_clock_gettime, clock, time));
}

extern "C" int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* rest) {
  if (fakeClock != nullptr && clock == CLOCK_MONOTONIC && flags == TIMER_ABSTIME)
    return fakeClock->sleepUntil(*time), 0;
  return kRealSleepOnClock(clock, flags, time, rest);
}
// NOLINTEND(misc-definitions-in-headers)
