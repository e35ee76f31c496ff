// Names of a program that look like mistakes: never used, read and never written, written and never read, set and never
// reset, or one over another (overlaps.h).
#pragma once
#include "frontend/sema/analysis.h"
#include "ir/layout/layout.h"
#include "ir/support/diagnostics.h"
#include "tools/xref/cross_reference.h"

namespace rung::xref {

// Warns at the declarations, unless the comment of one says `allow(CODE)` with the code of the warning. What an index
// may lead to counts as read or written, and so does what the control or the machine does; what is kept through
// power-off the operator may set and look at. The coil that an instruction must have needs no reader.
void reportOddNames(const SourceManager& sources, const frontend::Analysis& analysis, const CrossReference& reference,
                    Diagnostics& diagnostics);
// The same of a program that is laid out; `shown`: see CrossReference.
void reportOddNames(const SourceManager& sources, const frontend::Analysis& analysis, const ir::Layout& layout,
                    const ir::Uses& uses, std::span<const std::string_view> shown, Diagnostics& diagnostics);

} // namespace rung::xref
