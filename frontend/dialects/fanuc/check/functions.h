// Checks of functions that need more than their operands: conditions that are constant, the type of the PMC, the
// control beside the program.
#pragma once
#include "frontend/network/read/context.h"

namespace rung::frontend::fanuc {

// `isSimulated`: the program runs beside the simulated CNC.
void checkFunctions(network::Context& context, const network::Program& program, bool isSimulated);

} // namespace rung::frontend::fanuc
