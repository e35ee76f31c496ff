// Where the parts of a program are in the module that was built of it.
#pragma once
#include <vector>

#include "frontend/dialects/technol/records.h"

namespace rung::frontend::technol {

struct Trace {
  // Rungs of a statement; without a routine: it has none.
  struct Statement {
    ir::RoutineId routine;
    uint32_t first = UINT32_MAX;
    uint32_t last = 0;
  };
  // A unit that waits. Its rung `dispatch` ends with a switch over the states.
  struct Sequence {
    UnitId unit;
    std::string continuation; // key of the ir::Continuation
    ir::RoutineId routine;
    uint32_t dispatch = 0;
  };
  std::vector<Statement> statements; // by index
  std::vector<Sequence> sequences;   // in the order in which they end
};

} // namespace rung::frontend::technol
