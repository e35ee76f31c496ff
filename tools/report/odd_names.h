// Names of a program that look like mistakes: never used, read and never written, written and never read, set and never
// reset, or one over another (overlaps.h).
#pragma once
#include "frontend/sema/analysis.h"
#include "ir/shape/layout.h"
#include "ir/support/diagnostics.h"
#include "tools/report/cross_reference.h"

namespace rung::report {

struct OddName {
  const frontend::Definition* definition = nullptr; // from the analysis
  Diag code{};                                      // code of the warning
  SourceRange operand;                              // an operand that shows it; invalid: none does
};

// The odd names, except those whose declaration has a comment `allow(CODE)` with the code of the warning. A place that
// an index may reach counts as read or written, and so does one that the control or the machine uses; the operator may
// set and look at what is retained. A coil that an instruction requires needs no reader.
std::vector<OddName> oddNames(const SourceManager& sources, const frontend::Analysis& analysis,
                              const CrossReference& reference);
// Warns of these names, and of names that overlap others, at the declarations.
void reportOddNames(const SourceManager& sources, const frontend::Analysis& analysis, const CrossReference& reference,
                    Diagnostics& diagnostics);
// The same for a program whose memory is laid out; `shown`: see CrossReference.
void reportOddNames(const SourceManager& sources, const frontend::Analysis& analysis, const ir::Layout& layout,
                    const ir::Uses& uses, std::span<const std::string_view> shown, Diagnostics& diagnostics);
// Marks the entries that are declared and what is odd about them; of the addresses that the program's operands name by
// the same rules. Names that the control itself has are never odd.
void markOdd(const SourceManager& sources, const frontend::Analysis& analysis, const CrossReference& reference,
             std::vector<Entry>& entries);

} // namespace rung::report
