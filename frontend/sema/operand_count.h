// The number of operands of an instruction.
#pragma once
#include <string>
#include <string_view>

#include "frontend/table/instruction.h"
#include "ir/support/diagnostics.h"

namespace rung::frontend {

// Whether an instruction takes `found` operands. False after the report operand-count at `at`, with a list of the
// operands and, if it is not empty, `note`.
bool countFits(const InstructionInfo& info, size_t found, SourceRange at, Diagnostics& diagnostics,
               std::string_view note = {});

// "its operands in order: Result, Operand" for a note.
std::string operandOrder(const InstructionInfo& info);

} // namespace rung::frontend
