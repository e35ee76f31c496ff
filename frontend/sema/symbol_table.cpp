// Errors about names that are declared twice or not at all (see symbol_table.h).
#include "frontend/sema/symbol_table.h"

#include "ir/support/diag/operand.h"

namespace rung::frontend {

void reportDuplicate(Diagnostics& diagnostics, std::string_view name, SourceRange range, SourceRange first,
                     std::string_view note) {
  diagnostics.report(diag::DuplicateSymbol, range).note(first, first.valid() ? note : "it is predefined by the control")
      << name;
}

std::string asWritten(std::string_view name) { return std::string(name); }

void noteFurtherUses(DiagBuilder& report, SourceRange second, size_t further) {
  report.note(second, further == 1 ? "it is used once more, here"
                                   : "and " + std::to_string(further) + " further uses; the next is here");
}

} // namespace rung::frontend
