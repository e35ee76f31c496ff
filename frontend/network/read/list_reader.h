// Command lists (P12): one statement a line.
#pragma once
#include <optional>
#include <span>

#include "frontend/network/read/context.h"
#include "frontend/network/read/list_syntax.h"
#include "frontend/network/read/units.h"

namespace rung::frontend::network {

// The `symbol` and `const` statements of a file; they hold for the whole program, so they are read before all networks.
void readListSymbols(Context& context, FileId file);
void readList(Context& context, FileId file, UnitAssembler& units);
// The last line with something on it, for errors about what is missing at the end.
SourceRange lastLineOf(const SourceManager& sources, FileId file);

} // namespace rung::frontend::network
