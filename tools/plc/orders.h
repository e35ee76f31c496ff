// What another thread asks of the thread that scans a program, which does it between two slices: a slot for one order
// at a time, in which neither waits for the other.
#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

#include "rung/runtime.h"

namespace rung::plc {

struct Order {
  enum class Kind : uint8_t {
    State,   // the instance's state
    Write,   // `value` into `cell`; `former` is what was there
    Forced,  // the force in effect number `index`
    Force,   // `forces` are in effect from now on; null: none
    Replace, // by the program of `replacement`
    Shadow,  // `shadow` begins; null: it ends
    Stop,
    Start,
    Restart, // after a fault
    Act,     // `act` does it, with `actor`
    Profile, // the counters of the rungs from `index` on, `count` of them at most, into `profiles`; `count`: of how
             // many
    ClearProfile,
  };
  Kind kind = Kind::State;
  rung_cell cell = 0;
  rung_value value{};
  uint32_t index = 0;
  uint32_t count = 0;
  rung_forces* forces = nullptr;
  rung_replacement* replacement = nullptr;
  rung_shadow* shadow = nullptr;
  void (*act)(void* actor) = nullptr;
  void* actor = nullptr;
  rung_profile* profiles = nullptr; // of whoever gives the order
  // Results.
  rung_value former{};
  rung_state state{};
  rung_force_info force{};
};

// What became of an order.
struct Answer {
  int32_t status = RUNG_OK; // enum rung_status; RUNG_FAILED also where nobody scans
  std::string problem;      // a sentence where it is an error, or RUNG_LATER
  bool ok() const { return status == RUNG_OK || status == RUNG_EMPTY; }
};

class OrderSlot {
public:
  // For all threads but the scan's, which may wait here for each other. Results are in `order`. What the scan thread
  // cannot do now it tries again, until the time is over: then the order is withdrawn, and has done nothing.
  Answer give(Order& order, std::chrono::milliseconds time);

  // The scan thread, between two slices: `obey` does the order and gives a status; after an error, and RUNG_LATER, it
  // leaves the sentence of rung_error_text.
  template <class Obey>
  void take(Obey obey) noexcept {
    int expected = kPosted;
    if (!state_.compare_exchange_strong(expected, kTaken, std::memory_order_acquire)) return;
    status_ = obey(order_);
    if (status_ < RUNG_OK || status_ == RUNG_LATER) keepProblem();
    state_.store(status_ == RUNG_LATER ? kPosted : kDone, std::memory_order_release);
  }

private:
  static constexpr int kFree = 0, kPosted = 1, kTaken = 2, kDone = 3;
  void keepProblem() noexcept;
  bool withdraw() noexcept;

  std::mutex giving_;
  std::atomic<int> state_{kFree};
  Order order_;
  int32_t status_ = RUNG_OK;
  char problem_[512] = "";
};

} // namespace rung::plc
