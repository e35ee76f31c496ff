// Warnings that a declaration's comment suppresses.
#pragma once
#include "frontend/sema/analysis.h"
#include "ir/support/allowance.h"
#include "ir/support/diagnostics.h"

namespace rung::report {

inline bool isAllowed(const frontend::Definition& definition, Diag code) {
  return allows(definition.comment, diagInfo(code).code);
}

} // namespace rung::report
