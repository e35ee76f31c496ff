// Exchange between a program and its control by identifiers: these as words of eight characters, with requests that the
// control answers at once.
#pragma once
#include <vector>

#include "frontend/dialects/technol/lower/memory.h"

namespace rung::frontend::technol {

// The characters of an operand of kind "text or literal", padded with zeros. Of a text in memory, all bytes up to the
// end of its variable; the control stops at the terminator.
std::vector<ir::ValueId> identifierWords(Memory& memory, const Operand& id, uint32_t words);
// Requests that a variable become known to the control; `head` are the arguments before the identifier. Returns the
// ticket.
ir::ValueId defineRequest(Memory& memory, std::span<const ir::ValueId> head, const Operand& id);
// Whether a result is not 0; 0 if there is no answer.
ir::ValueId answersYes(ir::RungBuilder& b, ir::ValueId ticket, uint32_t result);

} // namespace rung::frontend::technol
