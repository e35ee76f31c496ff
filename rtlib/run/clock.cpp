// The clock of the system.
#include "rtlib/run/clock.h"

#include <chrono>
#include <ctime>
#include <thread>

#include "rtlib/run/realtime.h"

namespace rung::runtime {

namespace {

class SystemClock final : public Clock {
public:
  int64_t nowNs() noexcept override { return monotonicNs(); }
  int64_t dateS() noexcept override { return std::time(nullptr); }
  void sleep(int64_t ns) override { std::this_thread::sleep_for(std::chrono::nanoseconds(ns)); }
};

} // namespace

Clock& systemClock() noexcept {
  static SystemClock clock;
  return clock;
}

} // namespace rung::runtime
