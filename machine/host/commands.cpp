// See commands.h.
#include "machine/host/commands.h"

#include <cassert>
#include <cstring>
#include <thread>

namespace rung::host {

void CommandSlot::keep(const Outcome& outcome) noexcept {
  status_ = outcome.status;
  const size_t length = strnlen(outcome.problem, sizeof problem_ - 1);
  std::memcpy(problem_, outcome.problem, length);
  problem_[length] = '\0';
}

// False: it is done after all.
bool CommandSlot::withdraw() noexcept {
  for (int expected = kPosted; !state_.compare_exchange_weak(expected, kFree, std::memory_order_acquire);
       expected = kPosted) {
    if (expected == kDone) return false;
    std::this_thread::yield(); // taken: not for long
  }
  return true;
}

void CommandSlot::post(const Command& command) {
  assert(state_.load(std::memory_order_relaxed) == kFree);
  order_ = command;
  status_ = RUNG_OK;
  problem_[0] = '\0';
  state_.store(kPosted, std::memory_order_release);
}

CommandResult CommandSlot::take(Command& command) {
  if (!isDone() && withdraw()) {
    if (status_ == RUNG_LATER) return {RUNG_LATER, problem_};
    return {RUNG_FAILED, "the scan thread does not run"};
  }
  command = order_;
  const CommandResult answer{status_, problem_};
  state_.store(kFree, std::memory_order_release);
  return answer;
}

} // namespace rung::host
