// Checks how the rungs of a module hang together: END, labels and jumps, subroutines and calls (man. §6.14). Fills in
// the module's bodies, labels and subroutines.
#pragma once
#include "frontend/dialects/nct/program.h"

namespace rung::nct {

void checkStructure(TypedModule& module, const SourceManager& sources, Diagnostics& diagnostics);

} // namespace rung::nct
