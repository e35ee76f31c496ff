// The longest path that control can take through a task: with the time of a step on a machine, the bound of a run
// there. Any other cost of rungs is added up along paths in the same way.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "ir/shape/partition.h"

namespace rung::ir {

// Where the loops of a run end.
struct LoopFreeEnd {
  uint32_t chunk = RUNG_PC_DONE; // from this chunk on, outside of calls, no loops; RUNG_PC_DONE: no such chunk
  uint32_t weight = 0;           // of the longest path from there or from a later chunk, at most UINT32_MAX
};

struct LongestRun {
  uint32_t weight = 0;  // at most the task's budget
  bool loops = false;   // control may loop; the weight is that of a path without the jumps that close loops
  LoopFreeEnd loopFree; // not set for a partitioned task
};

// Of a task, or of the longest of its parts.
LongestRun longestRun(const Partition& partition, TaskId task);

// The part of a path that lies in one routine.
struct RoutinePath {
  struct Call {
    uint32_t rung = 0;
    RoutineId callee;
  };
  RoutineId routine;
  uint64_t runs = 1;           // executions of the routine on the whole path
  uint64_t cost = 0;           // of one execution, with its calls
  std::vector<uint32_t> rungs; // by number, in execution order
  std::vector<Call> calls;     // in execution order
};

struct LongestPath {
  uint64_t cost = 0; // UINT64_MAX: at least that
  uint32_t part = 0; // of a partitioned task: the longest part, from 0
  // The task's own routine first, each routine before those that it calls. Every execution of a routine takes the same
  // path.
  std::vector<RoutinePath> routines;
  // Sets of rungs among which control may loop, by number, ascending.
  std::vector<std::vector<uint32_t>> loops;
};

// `costs`: by rung number (rung_costs.h).
LongestPath longestPath(const Partition& partition, TaskId task, std::span<const uint64_t> costs);

} // namespace rung::ir
