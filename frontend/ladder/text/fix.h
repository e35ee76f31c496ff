// Fixes of words in drawings that keep the columns.
#pragma once
#include <span>
#include <string_view>

#include "ir/support/diagnostics.h"
#include "rtlib/text/similar.h"

namespace rung::frontend::ladder {

/// Adds "did you mean WORD?" and the fix that replaces `range`, as DiagBuilder::meant. In a drawing the wire to the
/// right of the element becomes longer or shorter, so that later elements keep their columns; without room for that
/// there is no fix.
void meant(DiagBuilder& report, const SourceManager& sources, SourceRange range, std::string_view word);
/// Adds only that fix, if a note already says what is meant.
void fix(DiagBuilder& report, const SourceManager& sources, SourceRange range, std::string_view word);

/// The same for a possibly misspelt word that occurs at all these positions, in this order: with a fix of all of them,
/// and only if nothing else can have been meant.
void suggest(DiagBuilder& report, const SourceManager& sources, std::span<const SourceRange> places,
             const text::Likely& likely);
inline void suggest(DiagBuilder& report, const SourceManager& sources, SourceRange range, const text::Likely& likely) {
  suggest(report, sources, {&range, 1}, likely);
}

} // namespace rung::frontend::ladder
