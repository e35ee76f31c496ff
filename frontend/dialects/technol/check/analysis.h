// The meaning of the names and operands of a checked program, for tools.
#pragma once

#include "frontend/dialects/technol/check/typed.h"
#include "frontend/sema/analysis.h"

namespace rung::frontend::technol {

Analysis analysisOf(const TypedProgram& program);

} // namespace rung::frontend::technol
