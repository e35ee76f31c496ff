// Fixes of words in drawings, whose columns must stay.
#pragma once
#include <span>
#include <string_view>

#include "ir/support/diagnostics.h"
#include "rtlib/text/similar.h"

namespace rung::frontend::ladder {

/// "did you mean WORD?" and the fix that puts it into the place of `range`, as DiagBuilder::meant. In a drawing the
/// wire on the right of the element becomes longer or shorter, so that what follows keeps its column; without room
/// for that the fix is left out.
void meant(DiagBuilder& report, const SourceManager& sources, SourceRange range, std::string_view word);
/// That fix alone, where a note says already what is meant.
void fix(DiagBuilder& report, const SourceManager& sources, SourceRange range, std::string_view word);

/// The same of a word that may be misspelt, and is at all these places, in their order: with a fix of all of them, and
/// only where nothing else can have been meant.
void suggest(DiagBuilder& report, const SourceManager& sources, std::span<const SourceRange> places,
             const text::Likely& likely);
inline void suggest(DiagBuilder& report, const SourceManager& sources, SourceRange range, const text::Likely& likely) {
  suggest(report, sources, {&range, 1}, likely);
}

} // namespace rung::frontend::ladder
