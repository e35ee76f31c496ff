// Reads the files of a program into statements. It resolves what determines the structure (modules, units, labels,
// names, constants); operands of executable statements remain tokens until they are checked.
#pragma once

#include "frontend/dialects/technol/read/read_context.h"

namespace rung::frontend::technol {

// Fills the parts of `context` from files in order, the first being the main file, and assigns addresses to all data.
void readProgram(ReadContext context, std::span<const FileId> files);

} // namespace rung::frontend::technol
