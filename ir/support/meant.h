// "Did you mean …" in a report.
#pragma once
#include <span>

#include "ir/support/diagnostics.h"
#include "rtlib/text/similar.h"

namespace rung {

/// With the fix only if nothing else can have been meant: a tool that applies it without asking must not change the
/// logic.
inline void suggest(DiagBuilder& report, SourceRange range, const text::Likely& likely) {
  report.meant(likely.certain ? range : SourceRange{}, likely.word);
}

/// The same for a word that occurs at all these positions: the fix corrects all of them.
inline void suggestAt(DiagBuilder& report, std::span<const SourceRange> places, const text::Likely& likely) {
  suggest(report, places.front(), likely);
  for (const SourceRange place : places.subspan(1))
    if (likely.certain) report.fix(place, likely.word);
}

} // namespace rung
