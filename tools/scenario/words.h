// Words of a scenario's line and the numbers, texts and times that they write.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tools/scenario/scenario.h"

namespace rung::scenario {

struct ScenarioWord {
  std::string text; // a quoted text without its quotes; KEY="a b" keeps them, see valueOfKey
  bool quoted = false;
};

// Words of a line up to a comment. Gives "" or what is wrong.
std::string splitLine(std::string_view line, std::vector<ScenarioWord>& words);

// A number, a bit as on, off, true or false, else a text.
Value valueOf(const ScenarioWord& word);
// What follows the = of KEY=VALUE, which may be in quotes.
Value valueOfKey(const std::string& text);

bool isTimeUnit(std::string_view text);

} // namespace rung::scenario
