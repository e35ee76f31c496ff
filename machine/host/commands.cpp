// See commands.h.
#include "machine/host/commands.h"

#include <cstring>

namespace rung::host {

void CommandSlot::Posted::keep(const Outcome& outcome) noexcept {
  status = outcome.status;
  const size_t length = strnlen(outcome.problem, sizeof problem - 1);
  std::memcpy(problem, outcome.problem, length);
  problem[length] = '\0';
}

CommandResult CommandSlot::take(Command& command) {
  const bool done = slot_.isDone() || !slot_.withdraw();
  const Posted& posted = slot_.command();
  if (!done) {
    if (posted.status == RUNG_LATER) return {RUNG_LATER, posted.problem};
    return {RUNG_FAILED, "the scan thread does not run"};
  }
  command = posted.command;
  CommandResult answer{posted.status, posted.problem};
  slot_.release();
  return answer;
}

} // namespace rung::host
