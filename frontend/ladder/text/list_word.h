// Words of instruction lists (IEC 61131, GSK, Mitsubishi, FANUC, Siemens, Rockwell), and their equivalents in a
// drawing.
#pragma once
#include <span>
#include <string_view>

#include "frontend/syntax/word_lexer.h"

namespace rung::frontend::ladder {

/// "a closed contact [/x] in series" for ANDN, ignoring case; empty for other words.
std::string_view drawnFor(std::string_view listWord);

/// Whether the words are a line of an instruction list, possibly with its line number.
bool isListLine(std::span<const Word> words);

inline constexpr std::string_view kListNote =
    "this is a line of an instruction list, and the file is read as ladder text, in which contacts and coils are drawn "
    "below a `rung` statement: |--[x]--[/y]--(z)";

} // namespace rung::frontend::ladder
