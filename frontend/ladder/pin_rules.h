// What the rows of a dialect say of the pins of a drawing.
#pragma once
#include "frontend/ladder/rung.h"
#include "frontend/table/instruction.h"

namespace rung::frontend::ladder {

/// Whether two names of pins are one to the dialect.
using SameName = bool (*)(std::string_view a, std::string_view b);

/// The pins of a box against those of its row: reports those that are missing, and those that it does not have.
bool checkPins(const frontend::InstructionInfo& info, std::span<const Pin> drawn, SourceRange box, SameName same,
               Diagnostics& diagnostics);

/// Whether a pin is at the left rail although its element needs a condition, or is not although it takes none. How that
/// is said is the dialect's business.
bool isMisplaced(const frontend::InstructionInfo& info, const Pin& pin);

} // namespace rung::frontend::ladder
