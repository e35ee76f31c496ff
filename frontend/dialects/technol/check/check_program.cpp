// Checks the code of a program, statement by statement (see check_program.h).
#include "frontend/dialects/technol/check/check_program.h"

#include "frontend/dialects/technol/check/check_context.h"
#include "frontend/dialects/technol/check/operand_parser.h"

namespace rung::frontend::technol {
namespace {

// Checks the part of a module in one file. Each part begins without an open equation.
class PartChecker {
public:
  PartChecker(TypedProgram& typed, OperandParser& parser, ProcedureCalls& calls, Diagnostics& diagnostics)
      : program_(typed.source), typed_(typed), parser_(parser), calls_(calls), diagnostics_(diagnostics),
        equation_(diagnostics), lost_(diagnostics), mixing_(diagnostics) {}

  void check(const ModulePart& part) {
    for (uint32_t i = part.firstStatement; i < part.endStatement && i < program_.statements.size(); ++i)
      check(program_.statements[i], typed_.statements[i]);
    if (!part.cut) equation_.end(part.end, moduleName(part.kind));
  }

private:
  void check(const Statement& statement, Typed& typed);
  void unitBorder(const Statement& statement);
  bool parse(const Statement& statement, Typed& typed);
  void code(const Statement& statement, Typed& typed);

  const SourceProgram& program_;
  TypedProgram& typed_;
  OperandParser& parser_;
  ProcedureCalls& calls_;
  Diagnostics& diagnostics_;
  Equation equation_;
  LostRegisters lost_;
  Mixing mixing_;
};

void PartChecker::check(const Statement& statement, Typed& typed) {
  if (statement.label != kNone) { // a jump may lead here
    lost_.forget();
    mixing_.forget();
  }
  if (statement.row == nullptr) return equation_.unknown();
  switch (statement.row->role) {
  case Role::Code: return code(statement, typed);
  case Role::MechBegin:
  case Role::MechEnd:
  case Role::ProcBegin:
  case Role::ProcEnd: return unitBorder(statement);
  case Role::Timed: parse(statement, typed); return;
  case Role::MacroBegin: typed.stack = equation_.beginMacro(statement); return;
  case Role::MacroEnd: return equation_.endMacro(statement);
  default: return; // not executed
  }
}

void PartChecker::unitBorder(const Statement& statement) {
  equation_.end(statement.range(), statement.row->info.mnemonic);
  if (statement.row->role != Role::ProcEnd) lost_.forget();
}

bool PartChecker::parse(const Statement& statement, Typed& typed) {
  typed.firstOperand = static_cast<uint32_t>(typed_.operands.size());
  const bool parsed = parser_.parse(statement, typed_.operands);
  typed.operandCount = static_cast<uint32_t>(typed_.operands.size()) - typed.firstOperand;
  return parsed;
}

// Whether the statement reads DR. Some instructions do so only if their operand is omitted.
bool readsDr(const Row& row, std::span<const Operand> operands) {
  if ((row.effects & kReadsDr) == 0) return false;
  if ((row.effects & kDrIfNotGiven) == 0) return true;
  for (size_t i = 0; i < operands.size(); ++i) {
    const OperandInfo& info = row.info.operands[i];
    if (info.optional || mayBeOmitted(info)) return !operands[i].given();
  }
  return true;
}

void PartChecker::code(const Statement& statement, Typed& typed) {
  const Row& row = *statement.row;
  const bool parsed = parse(statement, typed);
  lost_.begin(statement, readsDr(row, typed_.operandsOf(typed)));
  typed.stack = equation_.begin(statement);
  if (parsed && row.check != nullptr)
    row.check({program_, typed_.declarations, diagnostics_, statement, equation_, mixing_, calls_},
              typed_.operandsOf(typed), row.variant);
  equation_.finish(row);
  lost_.finish(row, (row.effects & kWaits) != 0 && program_.mayWait(statement.unit));
}

} // namespace

TypedProgram checkProgram(const SourceProgram& program, const Declarations& declarations, Symbols& symbols,
                          std::string_view axisNames, Diagnostics& diagnostics) {
  TypedProgram typed{.source = program, .declarations = declarations, .symbols = symbols};
  typed.statements.resize(program.statements.size());
  OperandParser parser(typed, symbols, axisNames, diagnostics);
  ProcedureCalls calls(program);
  for (const ModulePart& part : program.parts)
    if (part.kind != ModuleKind::Data) PartChecker(typed, parser, calls, diagnostics).check(part);
  calls.check(program, diagnostics);
  symbols.reportUndefined();
  return typed;
}

} // namespace rung::frontend::technol
