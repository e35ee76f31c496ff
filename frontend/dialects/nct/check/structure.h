// Checks the structure of a module: END, labels and jumps, subroutines and calls (man. §6.14). Fills in the module's
// bodies, labels and subroutines.
#pragma once
#include "frontend/dialects/nct/program.h"

namespace rung::frontend::nct {

// Moves a file's part of a module that begins with a subroutine and precedes the part with END to the end: such a file
// contains subroutines, and files may be named in any order.
void arrangeParts(TypedModule& module);

void checkStructure(TypedModule& module, const SourceManager& sources, Diagnostics& diagnostics);

// By rung, whether every run of the module evaluates it exactly once: it is in the main part, and no jump leads over it
// or back over it. The only exception is a fault, which stops the program.
std::vector<bool> evaluatedOncePerRun(const TypedModule& module);

} // namespace rung::frontend::nct
