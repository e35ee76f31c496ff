// A unit that waits as a sequence of parts: from a place where control enters it to the next one.
#pragma once
#include <functional>

#include "frontend/chart/chart.h"
#include "frontend/dialects/technol/check/typed.h"
#include "frontend/dialects/technol/lower/trace.h"

namespace rung::frontend::technol {

// What drawings need of a program that was built.
struct Built {
  const TypedProgram& program;
  const Trace& trace;
  const ir::Module& module;                             // as it was built
  const std::vector<uint32_t>& rungs;                   // by statement: the number of its rung; 0: none
  const std::vector<std::vector<uint32_t>>& statements; // of each unit that is not a timed block
};

chart::Sequence sequenceOf(const Built& built, const Trace::Sequence& sequence);

} // namespace rung::frontend::technol
