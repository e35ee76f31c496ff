// Checks how the rungs of a module hang together: END, labels and jumps, subroutines and calls (man. §6.14). Fills in
// the module's bodies, labels and subroutines.
#pragma once
#include "frontend/dialects/nct/program.h"

namespace rung::frontend::nct {

// A file's part of a module that begins with a subroutine and is before the part with END goes after all
// others: such a file holds subroutines, and files may be named in any order.
void arrangeParts(TypedModule& module);

void checkStructure(TypedModule& module, const SourceManager& sources, Diagnostics& diagnostics);

// By rung: every run of the module evaluates it, and once. So it is in the main part, and no jump leads over it or back
// over it. A fault, which stops the program, is the one exception.
std::vector<bool> evaluatedOncePerRun(const TypedModule& module);

} // namespace rung::frontend::nct
