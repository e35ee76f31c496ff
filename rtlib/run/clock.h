// The computer's clock, for the threads that may wait: a host passes one Clock to all its parts. A test passes a clock
// of its own, whose time advances only when the test says so.
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
  virtual int64_t nowNs() noexcept = 0;  // CLOCK_MONOTONIC
  virtual int64_t dateNs() noexcept = 0; // since 1970, UTC
  virtual void sleep(int64_t ns) = 0;    // gives the processor to other threads
  int64_t dateS() noexcept { return dateNs() / 1'000'000'000; }
};

Clock& systemClock() noexcept;

// Alone checks, in debug builds, a promise that comments make about threads: only one thread at a time executes a
// section of code, and never enters it again from within.

class Alone {
public:
  // Marks the section: entered here, left at the end of the scope.
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

// The disk and the period of saving that a host of a program uses. A test passes a disk of its own.

struct Outside {
  Disk* disk = &systemDisk();
  // How often the thread of RetainSaver checks whether retained memory has to be written. Nothing: as the dialect needs
  // it. 0: RetainSaver has no thread.
  std::optional<std::chrono::milliseconds> savePeriod;
};

} // namespace rung::runtime
