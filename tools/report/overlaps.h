// Names of a program that overlap one another.
#pragma once
#include "frontend/sema/analysis.h"
#include "ir/support/diagnostics.h"
#include "tools/report/cross_reference.h"

namespace rung::report {

// Warns of two names of different width with bits in common, and of two names of one input or output, unless the
// comment of one of the declarations allows it or one is declared in terms of the other. A name is as wide as its
// declaration says, or as an instruction takes it. Names for a word's bits are accepted if the program does not compute
// with the word or does not write the bits; so is everything that it never writes.
void reportOverlaps(const SourceManager& sources, const frontend::Analysis& analysis, const CrossReference& reference,
                    Diagnostics& diagnostics);

} // namespace rung::report
