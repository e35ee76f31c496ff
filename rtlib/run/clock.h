// The machine's clock, and waiting on it, for threads that are not in a scan. A host hands it to its parts; a test
// hands in one of its own, on which time passes when the test says so.
#pragma once
#include <atomic>
#include <cassert>
#include <chrono>
#include <cstdint>
#include <optional>

#include "rtlib/load/file.h"

namespace rung::runtime {

class Clock {
public:
  virtual ~Clock() = default;
  virtual int64_t nowNs() noexcept = 0; // CLOCK_MONOTONIC
  virtual int64_t dateS() noexcept = 0; // seconds since 1970, UTC
  virtual void sleep(int64_t ns) = 0;   // other threads run meanwhile
};

Clock& systemClock() noexcept;

// What comments promise of threads, and a debug build checks: one thread at a time is in a piece of the program, and
// does not come into it again from within.

class Alone {
public:
  // Until the end of the scope.
  class In {
  public:
#ifndef NDEBUG
    explicit In(Alone& alone) noexcept : alone_(alone) {
      const bool another = alone_.inside_.exchange(true, std::memory_order_acquire);
      assert(!another);
      (void)another;
    }
    ~In() { alone_.inside_.store(false, std::memory_order_release); }

  private:
    Alone& alone_;
#else
    explicit In(Alone&) noexcept {}
#endif
  public:
    In(const In&) = delete;
    In& operator=(const In&) = delete;
  };

private:
  std::atomic<bool> inside_{false};
};

// What a program's host uses of the machine: handed in, so that a test can have another one.

struct Outside {
  Disk* disk = &systemDisk();
  // How often a thread of its own looks whether retained memory is to be written; nothing: as the dialect needs it; 0:
  // RetainSaver has no thread.
  std::optional<std::chrono::milliseconds> savePeriod;
};

} // namespace rung::runtime
