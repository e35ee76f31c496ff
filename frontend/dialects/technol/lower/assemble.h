// The parts of a module besides code: spaces, symbols, tasks, the schedule of a scan.
#pragma once

#include "frontend/dialects/technol/lower/walk.h"

namespace rung::frontend::technol {

inline constexpr uint32_t kDefaultPeriodUs = 20'000; // man. l.2507

// Adds spaces in the order of symbols.h, initial contents, retained memory.
void addSpaces(const Declarations& declarations, ir::Module& module);
// Adds the program's names and the interface cells that it uses, in upper case. Must be called after lowering.
// `isCompared`: adds, as hidden symbols, also local names that other files have, with the names of their files, and
// those of macros.
void addSymbols(const TypedProgram& program, ir::Module& module, bool isCompared);
// Numbers the rungs by their first lines, in the order of the files; rungs that begin on one line share a number. The
// line that begins a module or a procedure is not a rung, unless it forms one with the instructions below it.
void numberRungs(const SourceProgram& source, ir::Module& module);
// Tasks have the names of their modules without MODULE_, event procedures their own.
void addTasks(const Declarations& declarations, const LoweredProgram& lowered, Emitter& emitter, uint32_t periodUs);

} // namespace rung::frontend::technol
