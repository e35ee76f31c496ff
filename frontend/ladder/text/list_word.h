// Words of instruction lists (IEC 61131, GSK, Mitsubishi, FANUC, Siemens, Rockwell), and how a drawing says the same.
#pragma once
#include <span>
#include <string_view>

#include "frontend/syntax/word_lexer.h"

namespace rung::frontend::ladder {

/// "a closed contact [/x] in series" for ANDN, in any case of letters; empty for a word that is none.
std::string_view drawnFor(std::string_view listWord);

/// Whether the words are a line of an instruction list, perhaps with its number before it.
bool isListLine(std::span<const Word> words);

inline constexpr std::string_view kListNote =
    "this is a line of an instruction list, and the file is read as ladder text, in which contacts and coils are drawn "
    "below a `rung` statement: |--[x]--[/y]--(z)";

} // namespace rung::frontend::ladder
