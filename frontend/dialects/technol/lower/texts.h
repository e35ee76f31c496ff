// Texts as instructions read and write them (man. ch. 3.18): characters up to a terminator, inside their variable.
#pragma once

#include "frontend/dialects/technol/lower/areas.h"

namespace rung::frontend::technol {

// A text, or the characters between apostrophes. `room`: characters it holds from the address on, at most `most`.
struct Text {
  Area area;
  uint32_t most = 0;
  ir::ValueId room;
  bool literal = false;
};

inline Length roomOf(const Text& text) { return {.fixed = text.area.fixed, .most = text.most, .value = text.room}; }
// An index that leads outside the text stops the program.
Text textOf(Memory& m, const Operand& operand);
// Characters in front of the terminator; a text without one has as many as it holds.
Length lengthOf(Memory& m, const Text& text);
void storeTerminator(Memory& m, const Area& area, ir::ValueId at, ir::ValueId cond);
// Whether one of the operands is a long text: what works on it has a rung of its own.
bool anyIsLong(std::span<const Operand> operands);

} // namespace rung::frontend::technol
