// Reads operands (man. §2, §4.5-4.8), independently of the instruction. Every function reports its mistakes at the
// exact characters and then returns nothing (or Form::Bad).
#pragma once
#include <optional>

#include "frontend/dialects/nct/read/symbols.h"

namespace rung::frontend::nct {

// The characters of `part`, which must be a part of word.text, in the source.
SourceRange rangeOf(const Word& word, std::string_view part);

// Adds a note how a number without the # or * of a constant, or in the form of another language, is written here. If
// the range is valid and the value of a foreign number is certain, with a fix.
void noteConstant(DiagBuilder& report, std::string_view text, const SourceManager& sources, SourceRange range);

// `text`, a part of `word`, begins with # or *.
std::optional<Constant> parseConstant(const Word& word, std::string_view text, const SourceManager& sources,
                                      Diagnostics& diagnostics);

struct ParsedAddress {
  Address address;
  const Symbol* base = nullptr; // null: digits
};
// Reads an address without modifiers. Names are looked up in `symbols`.
std::optional<ParsedAddress> parseAddress(const Word& word, std::string_view text, Symbols& symbols,
                                          Diagnostics& diagnostics);

// Reads an operand of a contact, coil or box, with its modifiers. A quoted word is Form::Text.
Operand parseOperand(const Word& word, Symbols& symbols, Diagnostics& diagnostics);

// The name of a quantity that SCP queries: a constant, its index in the list.
Operand parseScopeSymbol(const Word& word, Diagnostics& diagnostics);

// The number of a label or subroutine: #12, 12, or a constant's name (man. l.2942).
std::optional<uint32_t> parseLabel(const Word& word, Symbols& symbols, Diagnostics& diagnostics);

// "a word", "a bit", "a constant": for messages.
std::string_view describe(SymbolKind kind);

} // namespace rung::frontend::nct
