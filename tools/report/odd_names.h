// Names of a program that look like mistakes: never used, read and never written, written and never read, set and never
// reset, or one over another (overlaps.h).
#pragma once
#include "frontend/sema/analysis.h"
#include "ir/shape/layout.h"
#include "ir/support/diagnostics.h"
#include "tools/report/cross_reference.h"

namespace rung::report {

struct OddName {
  const frontend::Definition* definition = nullptr; // of the analysis
  Diag code{};                                      // of the warning
  SourceRange operand;                              // that shows it; invalid: none does
};

// Without those whose comment in the declaration says `allow(CODE)` with the code of the warning. What an index may
// lead to counts as read or written, and so does what the control or the machine does; what is kept through power-off
// the operator may set and look at. The coil that an instruction must have needs no reader.
std::vector<OddName> oddNames(const SourceManager& sources, const frontend::Analysis& analysis,
                              const CrossReference& reference);
// Warns of these, and of names over others, at the declarations.
void reportOddNames(const SourceManager& sources, const frontend::Analysis& analysis, const CrossReference& reference,
                    Diagnostics& diagnostics);
// The same of a program that is laid out; `shown`: see CrossReference.
void reportOddNames(const SourceManager& sources, const frontend::Analysis& analysis, const ir::Layout& layout,
                    const ir::Uses& uses, std::span<const std::string_view> shown, Diagnostics& diagnostics);
// Says of the entries which are declared and what is odd about them; of addresses that the program's operands name by
// the same rules. Nothing is odd about what the control has by a name of its own.
void markOdd(const SourceManager& sources, const frontend::Analysis& analysis, const CrossReference& reference,
             std::vector<Entry>& entries);

} // namespace rung::report
