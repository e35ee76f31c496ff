// "Did you mean …" in a report.
#pragma once
#include <span>

#include "ir/support/diagnostics.h"
#include "rtlib/text/similar.h"

namespace rung {

/// With the fix only where nothing else can have been meant: what a tool puts there unasked must not change the logic.
inline void suggest(DiagBuilder& report, SourceRange range, const text::Likely& likely) {
  report.meant(likely.certain ? range : SourceRange{}, likely.word);
}

/// Of a word that is at all these places: the fix corrects all of them.
inline void suggestAt(DiagBuilder& report, std::span<const SourceRange> places, const text::Likely& likely) {
  suggest(report, places.front(), likely);
  for (const SourceRange place : places.subspan(1))
    if (likely.certain) report.fix(place, likely.word);
}

} // namespace rung
