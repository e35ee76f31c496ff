// One line of a scenario: between the words and the files.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "tools/scenario/scenario.h"

namespace rung::scenario {

struct ParsedLine {
  std::optional<Statement> statement; // nothing in an empty line, or when there is a problem
  std::string problem;
  bool shapesStart = false; // it decides, or may be meant to decide, how the program is compiled and started
};

ParsedLine parseLine(std::string_view line);

// Whether a name in `expect NAME VALUE` may be meant for a message; then the note is added to what is wrong.
bool isMessageWord(std::string_view name);
inline constexpr std::string_view kMessageNote = "; for a message write: expect_message NUMBER [on|off]";

// Statements that come before the first scan.
bool preparesStart(Kind kind);

} // namespace rung::scenario
