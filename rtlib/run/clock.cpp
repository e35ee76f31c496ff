// The clock of the system.
#include "rtlib/run/clock.h"

#include <chrono>
#include <thread>

#include "rtlib/run/realtime.h"

namespace rung::runtime {

namespace {

class SystemClock final : public Clock {
public:
  int64_t nowNs() noexcept override { return monotonicNs(); }
  int64_t dateNs() noexcept override {
    return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
  }
  void sleep(int64_t ns) override { std::this_thread::sleep_for(std::chrono::nanoseconds(ns)); }
};

} // namespace

Clock& systemClock() noexcept {
  static SystemClock clock;
  return clock;
}

} // namespace rung::runtime
