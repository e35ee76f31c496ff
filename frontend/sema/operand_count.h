// How many operands an instruction takes.
#pragma once

#include "frontend/table/instruction.h"
#include "ir/support/diagnostics.h"

namespace rung::frontend {

// Whether an instruction takes `found` operands. False after the report operand-count at `at`, with a list of them.
bool countFits(const InstructionInfo& info, size_t found, SourceRange at, Diagnostics& diagnostics);

} // namespace rung::frontend
