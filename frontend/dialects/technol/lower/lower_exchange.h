// What a program says to its control and asks it by identifiers: these as words of eight characters, requests that the
// control answers at once.
#pragma once
#include <vector>

#include "frontend/dialects/technol/lower/memory.h"

namespace rung::frontend::technol {

// The characters of an operand of kind "text or literal", filled up with zeros. Of a text in memory, bytes up to its
// end; the control ends it at its terminator.
std::vector<ir::ValueId> identifierWords(Memory& memory, const Operand& id, uint32_t words);
// Makes a variable known to the control; `head` are the arguments before the identifier. A ticket.
ir::ValueId defineRequest(Memory& memory, std::span<const ir::ValueId> head, const Operand& id);
// Whether a result is not 0; 0 if there is no answer.
ir::ValueId answersYes(ir::RungBuilder& b, ir::ValueId ticket, uint32_t result);

} // namespace rung::frontend::technol
