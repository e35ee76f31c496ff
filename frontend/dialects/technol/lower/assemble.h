// What surrounds the code of a module: spaces, symbols, tasks, the schedule of a scan.
#pragma once

#include "frontend/dialects/technol/lower/walk.h"

namespace rung::frontend::technol {

inline constexpr uint32_t kDefaultPeriodUs = 20'000; // man. l.2507

// Spaces in the order of symbols.h, memory that starts filled, memory that is kept.
void addSpaces(const Declarations& declarations, ir::Module& module);
// The program's names and those interface cells that it uses; upper case. Call when lowering is done.
// `isCompared`: local names that other files have as well are there, too, with the names of their files, and those of
// macros, hidden.
void addSymbols(const TypedProgram& program, ir::Module& module, bool isCompared);
// Numbers the rungs by their first lines, in the order of the files; rungs that begin on one line share a number. The
// line that begins a module or a procedure is not a rung, unless it and the instructions below it are one.
void numberRungs(const SourceProgram& source, ir::Module& module);
// Tasks are named as their modules without MODULE_, event procedures by their names.
void addTasks(const Declarations& declarations, const LoweredProgram& lowered, Emitter& emitter, uint32_t periodUs);

} // namespace rung::frontend::technol
