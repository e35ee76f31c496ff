// The symbol sections of a mnemonic file (inventory §1.4).
#pragma once
#include <functional>
#include <string_view>

#include "frontend/dialects/fanuc/read/sections.h"
#include "frontend/network/read/context.h"

namespace rung::frontend::fanuc {

// What takes the symbols and the remarks of a section, in their order.
struct SymbolSink {
  std::function<void(const Word& name, const Word& place, std::string_view comment)> symbol;
  std::function<void(std::string_view text)> remark;
};
// Reads a section `%@2`, `%@2-C`, … or `%@2-E(SYM=1 ADR=2 …)`. Reports lines that are not symbols.
void readSymbols(const SourceManager& sources, Diagnostics& diagnostics, FileId file, const Section& section,
                 const SymbolSink& sink);

// Declares a symbol of a bit, a byte, a subprogram or a label; reports a place that is none of these.
void addSymbol(network::Context& context, const Word& name, const Word& place, std::string_view comment);

} // namespace rung::frontend::fanuc
