// Reads the files of a program into statements. It resolves what decides the structure (modules, units, labels, names,
// constants); operands of executable statements stay tokens until they are checked.
#pragma once

#include "frontend/dialects/technol/program.h"

namespace rung::frontend::technol {

// Fills `program` from files in order, the first being the main file, and gives all data its addresses.
void readProgram(Program& program, std::span<const FileId> files);

// Value of a constant expression: number, character, constant, member, with + and - between. Reports and returns
// nothing when it is none. `names`: where its names are noted; may be null.
std::optional<int64_t> constantValue(Program& program, uint32_t file, std::span<const Token> tokens,
                                     SourceRange otherwise, std::vector<NameUse>* names = nullptr);

} // namespace rung::frontend::technol
