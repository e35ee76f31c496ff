// Reads the files of a program into statements. It resolves what decides the structure (modules, units, labels, names,
// constants); operands of executable statements stay tokens until they are checked.
#pragma once

#include "frontend/dialects/technol/read/read_context.h"

namespace rung::frontend::technol {

// Fills the parts of `context` from files in order, the first being the main file, and gives all data its addresses.
void readProgram(ReadContext context, std::span<const FileId> files);

} // namespace rung::frontend::technol
