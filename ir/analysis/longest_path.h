// The longest path that control can take through a task: with what a step costs on a machine, the longest that a run
// may last there. Whatever else rungs cost is added up along paths in the same manner.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "ir/shape/partition.h"

namespace rung::ir {

// The end of a run's loops.
struct Straight {
  uint32_t chunk = RUNG_PC_DONE; // from it on, outside of calls, control goes in no loops; RUNG_PC_DONE: never
  uint32_t weight = 0;           // of the longest path from there or from a later chunk, at most UINT32_MAX
};

struct LongestRun {
  uint32_t weight = 0; // at most the task's budget
  bool loops = false;  // control may go in loops; the weight is that of a way without the jump that closes one
  Straight straight;   // a task that is cut has none
};

// Of a task, or of the longest of its parts where it is cut.
LongestRun longestRun(const Partition& partition, TaskId task);

// The part of a way that lies in one routine.
struct RoutineWay {
  struct Call {
    uint32_t rung = 0;
    RoutineId callee;
  };
  RoutineId routine;
  uint64_t runs = 1;           // of it on the whole way
  uint64_t cost = 0;           // of one run, with what it calls
  std::vector<uint32_t> rungs; // by number, in their order
  std::vector<Call> calls;     // in their order
};

struct LongestPath {
  uint64_t cost = 0; // UINT64_MAX: at least that
  uint32_t part = 0; // of a cut task: the longest, from 0
  // The task's own first, each before those that it calls. Every run of a routine takes the same way.
  std::vector<RoutineWay> routines;
  // Rungs among which control may go in loops, by number, ascending.
  std::vector<std::vector<uint32_t>> loops;
};

// `costs`: by rung number (rung_costs.h).
LongestPath longestPath(const Partition& partition, TaskId task, std::span<const uint64_t> costs);

} // namespace rung::ir
