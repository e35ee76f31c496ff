// Names of a program that lie over one another.
#pragma once
#include "frontend/sema/analysis.h"
#include "ir/support/diagnostics.h"
#include "tools/report/cross_reference.h"

namespace rung::report {

// Warns of two names of different width with bits in common, and of two names of one input or output, unless the
// comment of one of the declarations allows it or one is declared by way of the other. A name is as wide as its
// declaration says, or as an instruction takes it. That a word's bits have names, too, is fine as long as the program
// does not compute with the word, or does not write the bits; and so is what it does not write at all.
void reportOverlaps(const SourceManager& sources, const frontend::Analysis& analysis, const CrossReference& reference,
                    Diagnostics& diagnostics);

} // namespace rung::report
