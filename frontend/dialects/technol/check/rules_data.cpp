// Checks of data instructions (man. ch. 3.9-3.16).
#include "frontend/dialects/technol/check/check_context.h"
#include "frontend/dialects/technol/check/rules.h"
#include "ir/support/diag/technol.h"

namespace rung::frontend::technol {

void checkLoad(const CheckContext& c, std::span<const Operand> o, int) {
  c.mixing.note(o[0].isReal() ? DrUse::LoadReal : DrUse::LoadInteger, c.statement);
}

void checkArithmetic(const CheckContext& c, std::span<const Operand> o, int) {
  c.mixing.note(o[0].isReal() ? DrUse::Real : DrUse::Integer, c.statement);
}

// An instruction whose integers do not matter.
void checkRealUse(const CheckContext& c, std::span<const Operand> o, int) {
  if (o[0].isReal()) c.mixing.note(DrUse::Real, c.statement);
}

void checkToReal(const CheckContext& c, std::span<const Operand>, int) { c.mixing.note(DrUse::LoadReal, c.statement); }

void checkToInteger(const CheckContext& c, std::span<const Operand>, int) {
  c.mixing.note(DrUse::LoadInteger, c.statement);
}

void checkMove(const CheckContext& c, std::span<const Operand> o, int) {
  if (o[0].type == o[1].type) return;
  c.report(diag::TypeMismatch, c.statement.range())
      << c.statement.row->info.mnemonic << describe(o[0].type) << describe(o[1].type);
}

} // namespace rung::frontend::technol
