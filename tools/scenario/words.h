// Splits a line of a scenario into words, and parses numbers, texts and times.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tools/scenario/scenario.h"

namespace rung::scenario {

struct ScenarioWord {
  std::string text; // without the quotes of a quoted text; KEY="a b" keeps them, see valueOfKey
  bool quoted = false;
};

// The words of a line up to a comment. Returns "" or what is wrong.
std::string splitLine(std::string_view line, std::vector<ScenarioWord>& words);
// The text as one word: in quotes if it has blanks, or begins like a comment, as symbols of FANUC may.
std::string asWord(const std::string& text);

// A number, a bit (on, off, true or false), or else a text.
Value valueOf(const ScenarioWord& word);
// Value of the text after the = of KEY=VALUE, which may be quoted.
Value valueOfKey(const std::string& text);

bool isTimeUnit(std::string_view text);

} // namespace rung::scenario
