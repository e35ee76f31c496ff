// What holds of the pins of every box.
#pragma once
#include "frontend/ladder/rung.h"
#include "frontend/table/instruction.h"

namespace rung::ladder {

/// Whether two names of pins are one to the dialect.
using SameName = bool (*)(std::string_view a, std::string_view b);

/// The pins of a box against those of its row: reports the first that is missing, and those that it does not have.
bool checkPins(const frontend::InstructionInfo& info, std::span<const Pin> drawn, SourceRange box, SameName same,
               Diagnostics& diagnostics);

} // namespace rung::ladder
