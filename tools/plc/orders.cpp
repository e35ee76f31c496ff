// See orders.h.
#include "tools/plc/orders.h"

#include <cstring>
#include <thread>

namespace rung::plc {

void OrderSlot::keepProblem() noexcept {
  const char* text = rung_error_text();
  const size_t length = strnlen(text, sizeof problem_ - 1);
  std::memcpy(problem_, text, length);
  problem_[length] = '\0';
}

// False: it is done after all.
bool OrderSlot::withdraw() noexcept {
  for (int expected = kPosted; !state_.compare_exchange_weak(expected, kFree, std::memory_order_acquire);
       expected = kPosted) {
    if (expected == kDone) return false;
    std::this_thread::yield(); // taken: not for long
  }
  return true;
}

Answer OrderSlot::give(Order& order, std::chrono::milliseconds time) {
  constexpr std::chrono::microseconds kLook(200);
  const std::lock_guard lock(giving_);
  order_ = order;
  status_ = RUNG_OK;
  problem_[0] = '\0';
  state_.store(kPosted, std::memory_order_release);
  const auto end = std::chrono::steady_clock::now() + time;
  bool done = false;
  while (!done && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(kLook);
    done = state_.load(std::memory_order_acquire) == kDone;
  }
  if (!done && withdraw()) {
    if (status_ == RUNG_LATER) return {RUNG_LATER, problem_};
    return {RUNG_FAILED, "the thread that scans the program does not run"};
  }
  order = order_;
  const Answer answer{status_, problem_};
  state_.store(kFree, std::memory_order_release);
  return answer;
}

} // namespace rung::plc
