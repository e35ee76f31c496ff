// The symbol sections of a mnemonic file (inventory §1.4).
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/dialects/fanuc/read/sections.h"
#include "frontend/network/read/context.h"

namespace rung::frontend::fanuc {

// The comments of a symbol: CM1, CM2, …, those of several languages. A comment may be empty, the last one is not.
using Comments = std::vector<std::string_view>;
// As the one comment that ladder text has, and back. A comment with ";;" in it becomes two.
inline constexpr std::string_view kNextComment = ";;";
std::string joined(const Comments& comments);
Comments commentsIn(std::string_view joined);

// What takes the symbols and the remarks of a section, in their order.
struct SymbolSink {
  std::function<void(const Word& name, const Word& place, const Comments& comments)> symbol;
  std::function<void(std::string_view text)> remark;
};
// Reads a section `%@2`, `%@2-C`, … or `%@2-E(SYM=1 ADR=2 …)`. Reports lines that are not symbols.
void readSymbols(const SourceManager& sources, Diagnostics& diagnostics, FileId file, const Section& section,
                 const SymbolSink& sink);

// Declares a symbol of a bit, a byte, a subprogram or a label, with its first comment that is not empty; reports a
// place that is none of these.
void addSymbol(network::Context& context, const Word& name, const Word& place, const Comments& comments);
// The same from ladder text, with joined comments.
void addDrawnSymbol(network::Context& context, const Word& name, const Word& place, std::string_view comment);

} // namespace rung::frontend::fanuc
