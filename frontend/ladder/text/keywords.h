// The words that begin a statement of ladder text, and their meaning for authors; and those of other languages.
#pragma once
#include <string_view>

namespace rung::frontend::ladder {

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
    {"data", "a line of another section of the control's file"},
    {"section", "a title above the rungs that follow"},
    {"rung", "begins a rung; its text is the rung's title"},
};

inline constexpr std::string_view kBeginsRung = "a rung begins with `rung` or `rung \"comment\"`";
inline constexpr std::string_view kBeginsSubprogram =
    "a subprogram begins with a box or a `module`; `rungc explain` with the dialect lists what there is";
inline constexpr std::string_view kEndsItself =
    "a program ends with its file; an instruction that ends a part of it is a box in a rung";
inline constexpr Keyword kForeignKeywords[] = {
    {"network", kBeginsRung},          {"end", kEndsItself}, {"end_program", kEndsItself}, {"sub", kBeginsSubprogram},
    {"subroutine", kBeginsSubprogram},
};

} // namespace rung::frontend::ladder
