// The meaning of the names and operands of a checked program, for tools.
#pragma once

#include "frontend/dialects/technol/check/typed.h"
#include "frontend/sema/analysis.h"

namespace rung::frontend::technol {

Analysis analysisOf(const TypedProgram& program);
// How an operand uses memory; without bits if it names none.
OperandUse useOf(const TypedProgram& program, const Operand& operand);
// The label or procedure that an operand names; without a scope if it names none.
TargetUse targetOf(const Symbols& symbols, uint32_t symbol, SourceRange range, bool defines);

} // namespace rung::frontend::technol
