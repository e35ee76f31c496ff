// The heaviest way that control can take through a task: with what a step costs on a machine, the longest that a run
// may last there. Whatever else rungs cost is added up along ways in the same manner.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "ir/shape/cut.h"

namespace rung::ir {

// The end of a run's circles.
struct Straight {
  uint32_t chunk = RUNG_PC_DONE; // from it on, outside of calls, control goes in no circles; RUNG_PC_DONE: never
  uint32_t weight = 0;           // of the heaviest way from there or from a later chunk, at most UINT32_MAX
};

struct HeaviestRun {
  uint32_t weight = 0;  // at most the task's budget
  bool circles = false; // control may go in circles; the weight is that of a way without the jump that closes one
  Straight straight;    // a task that is cut has none
};

// Of a task, or of the heaviest of its parts where it is cut.
HeaviestRun heaviestRun(const Cut& cut, TaskId task);

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

struct HeaviestWay {
  uint64_t cost = 0; // UINT64_MAX: at least that
  uint32_t part = 0; // of a cut task: the heaviest, from 0
  // The task's own first, each before those that it calls. Every run of a routine takes the same way.
  std::vector<RoutineWay> routines;
  // Rungs among which control may go in circles, by number, ascending.
  std::vector<std::vector<uint32_t>> circles;
};

// `costs`: by rung number (rung_costs.h).
HeaviestWay heaviestWay(const Cut& cut, TaskId task, std::span<const uint64_t> costs);

} // namespace rung::ir
