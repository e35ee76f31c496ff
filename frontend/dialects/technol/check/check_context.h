// What the check of a row sees: the statement, and what the statements before it have left.
#pragma once

#include "frontend/dialects/technol/check/calls.h"
#include "frontend/dialects/technol/check/equation.h"
#include "frontend/dialects/technol/check/registers_kept.h"

namespace rung::frontend::technol {

struct CheckContext {
  const SourceProgram& program;
  const Declarations& declarations;
  Diagnostics& diagnostics;
  const Statement& statement;
  Equation& equation;
  Mixing& mixing;
  ProcedureCalls& calls;

  DiagBuilder report(Diag id, SourceRange at) const { return diagnostics.report(id, at); }
  // False: the report is wrong-operand-kind.
  bool wrongKind(const Operand& operand, std::string_view is, std::string_view wanted) const {
    return reportWrongKind(diagnostics, operand, is, wanted);
  }
};

// Whether a text lies where its operand says; with BX it shows when the program runs. False after a report.
bool textFits(const CheckContext& c, const Operand& operand);

} // namespace rung::frontend::technol
