// Names that are declared twice (see names.h).
#include "frontend/sema/names.h"

#include "ir/support/diag/operand.h"

namespace rung::frontend {

void reportDuplicate(Diagnostics& diagnostics, std::string_view name, SourceRange range, SourceRange first,
                     std::string_view note) {
  diagnostics.report(diag::DuplicateSymbol, range).note(first, first.valid() ? note : "it is predefined by the control")
      << name;
}

} // namespace rung::frontend
