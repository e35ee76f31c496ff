// The machine's clock, and waiting on it, for threads that are not in a scan. A host hands it to its parts; a test
// hands in one of its own, on which time passes when the test says so.
#pragma once
#include <cstdint>

namespace rung::runtime {

class Clock {
public:
  virtual ~Clock() = default;
  virtual int64_t nowNs() noexcept = 0; // CLOCK_MONOTONIC
  virtual int64_t dateS() noexcept = 0; // seconds since 1970, UTC
  virtual void sleep(int64_t ns) = 0;   // other threads run meanwhile
};

Clock& systemClock() noexcept;

} // namespace rung::runtime
