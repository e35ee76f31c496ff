// How many operands an instruction takes.
#pragma once
#include <string>
#include <string_view>

#include "frontend/table/instruction.h"
#include "ir/support/diagnostics.h"

namespace rung::frontend {

// Whether an instruction takes `found` operands. False after the report operand-count at `at`, with a list of them and,
// where it is not empty, a further note.
bool countFits(const InstructionInfo& info, size_t found, SourceRange at, Diagnostics& diagnostics,
               std::string_view note = {});

// "its operands in order: Result, Operand" for a note.
std::string operandOrder(const InstructionInfo& info);

} // namespace rung::frontend
