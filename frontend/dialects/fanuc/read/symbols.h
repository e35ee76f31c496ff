// The symbol sections of a mnemonic file (inventory §1.4).
#pragma once
#include "frontend/dialects/fanuc/read/sections.h"
#include "frontend/network/read/context.h"

namespace rung::frontend::fanuc {

// Adds the symbols of a section `%@2`, `%@2-C`, … or `%@2-E(SYM=1 ADR=2 …)`. Reports lines that are not symbols.
void readSymbols(network::Context& context, FileId file, const Section& section);

} // namespace rung::frontend::fanuc
