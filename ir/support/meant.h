// "Did you mean …" in a report.
#pragma once
#include "ir/support/diagnostics.h"
#include "ir/support/similar.h"

namespace rung {

/// With the fix only where nothing else can have been meant: what a tool puts there unasked must not change the logic.
inline void suggest(DiagBuilder& report, SourceRange range, const Likely& likely) {
  report.meant(likely.certain ? range : SourceRange{}, likely.word);
}

} // namespace rung
