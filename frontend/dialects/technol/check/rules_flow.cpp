// Checks of where control goes, and of what depends on where a statement is.
#include "frontend/dialects/technol/check/check_context.h"
#include "frontend/dialects/technol/check/rules.h"
#include "ir/support/diag/technol.h"

namespace rung::frontend::technol {
namespace {

std::string describeUnit(const Unit& unit) {
  switch (unit.kind) {
  case UnitKind::Module: return std::string(unit.name);
  case UnitKind::Mechanism: return "mechanism " + std::string(unit.name);
  case UnitKind::Procedure: return "procedure " + std::string(unit.name);
  case UnitKind::Timed: return "a block of " + std::string(unit.name);
  }
  return {};
}

// Jumps stay inside their unit; the end label of a timed block counts as inside it.
void checkTarget(const CheckContext& c, const Operand& operand) {
  const SourceProgram& program = c.program;
  const Label& label = program.labels[operand.index];
  const Unit& unit = program.at(c.statement.unit);
  const bool ownEnd = unit.kind == UnitKind::Timed && label.unit == unit.parent &&
                      symbolKey(program.tokens[unit.endLabel].text) == symbolKey(label.name);
  if (label.unit == c.statement.unit || ownEnd) return;
  const bool leadsInto = unit.kind == UnitKind::Module && label.unit.valid();
  c.report(diag::JumpCrossesUnit, operand.range)
      << label.name << describeUnit(leadsInto ? program.at(label.unit) : unit);
}

} // namespace

void checkJump(const CheckContext& c, std::span<const Operand> o, int) { checkTarget(c, o[0]); }
void checkTimedEx(const CheckContext& c, std::span<const Operand> o, int) { checkTarget(c, o[2]); }

void checkEmptyStack(const CheckContext& c, std::span<const Operand>, int) {
  c.equation.checkBalance(c.statement.range(), "CHECK");
}

// A mechanism inside a timed block is in that block, too.
void checkTimer(const CheckContext& c, std::span<const Operand>, int) {
  UnitId unit = c.statement.unit;
  while (unit.valid() && c.program.at(unit).kind == UnitKind::Mechanism) unit = c.program.at(unit).parent;
  if (!unit.valid() || c.program.at(unit).kind != UnitKind::Timed)
    c.report(diag::TmOutsideDftm, c.statement.range()) << c.statement.row->info.mnemonic;
}

void checkCall(const CheckContext& c, std::span<const Operand> o, int) {
  c.calls.add(c.program.procedureOf(c.statement.unit), o[0].index, o[0].range);
}

} // namespace rung::frontend::technol
