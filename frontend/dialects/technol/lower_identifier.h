// Identifiers that a program gives to its control: as words of eight characters, and their check.
#pragma once

#include <vector>

#include "frontend/dialects/technol/lowering.h"

namespace rung::frontend::technol {

// The characters of an operand of kind "text or literal", filled up with zeros. Of a text in memory, bytes up to its
// end; the control ends it at its terminator.
std::vector<ir::ValueId> identifierWords(Lowering& l, const Operand& id, uint32_t words);

} // namespace rung::frontend::technol
