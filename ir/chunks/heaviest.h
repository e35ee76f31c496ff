// The heaviest way that control can take through a task: with what a step costs on a machine, the longest that a run
// may last there.
#pragma once
#include <cstdint>

#include "ir/chunks/cut.h"

namespace rung::ir {

struct HeaviestRun {
  uint32_t weight = 0;  // at most the task's budget
  bool circles = false; // control may go in circles; the weight is that of a way without the jump that closes one
};

// Of a task, or of the heaviest of its parts where it is cut.
HeaviestRun heaviestRun(const Cut& cut, TaskId task);

// The end of a run's circles.
struct Straight {
  uint32_t chunk = RUNG_PC_DONE; // from it on, outside of calls, control goes in no circles; RUNG_PC_DONE: never
  uint32_t weight = 0;           // of the heaviest way from there or from a later chunk, at most UINT32_MAX
};

// Of a task that is not cut: a cut one has none.
Straight straightEnd(const Cut& cut, TaskId task);

} // namespace rung::ir
