// The words that begin a statement of ladder text, and what they mean to its author.
#pragma once
#include <string_view>

namespace rung::ladder {

struct Keyword {
  std::string_view word;
  std::string_view meaning;
};
inline constexpr Keyword kKeywords[] = {
    {"dialect", "the control that the program is for; the first statement of a file"},
    {"module", "begins a module, which ends where the next one begins"},
    {"symbol", "gives an address a name"},
    {"const", "gives a constant a name"},
    {"message", "the text of a message"},
    {"button", "the title of a function button"},
    {"section", "a title above the rungs that follow"},
    {"rung", "begins a rung; its text is the rung's title"},
};

} // namespace rung::ladder
