// What comments promise of threads, and a debug build checks: one thread at a time is in a piece of the program, and
// does not come into it again from within.
#pragma once
#include <atomic>
#include <cassert>

namespace rung::runtime {

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

} // namespace rung::runtime
