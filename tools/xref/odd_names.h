// Names of a program that look like mistakes: never used, read and never written, written and never read.
#pragma once
#include "frontend/sema/analysis.h"
#include "ir/support/diagnostics.h"
#include "tools/xref/cross_reference.h"

namespace rung::xref {

// Warns at the declarations, unless the comment of one says `allow(CODE)` with the code of the warning. What an index
// may lead to counts as read or written, and so does what the control or the machine does; what is kept through
// power-off the operator may set and look at.
void reportOddNames(const SourceManager& sources, const frontend::Analysis& analysis, const CrossReference& reference,
                    Diagnostics& diagnostics);

} // namespace rung::xref
