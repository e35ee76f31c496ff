// Checks the code of a program that has been read.
#pragma once

#include "frontend/dialects/technol/check/typed.h"

namespace rung::frontend::technol {

// Reads the operands of all statements of code, and reports all mistakes in them and in the logic: the stack, registers
// lost at a wait, jumps, calls. For a program with errors, including those found while it was read, the result is what
// could be understood; it must not be lowered. `symbols` receives the names of the control that the operands use.
// `axisNames`: of axes 1 and up, separated by blanks; empty: those of the rows.
TypedProgram checkProgram(const SourceProgram& program, const Declarations& declarations, Symbols& symbols,
                          std::string_view axisNames, Diagnostics& diagnostics);

} // namespace rung::frontend::technol
