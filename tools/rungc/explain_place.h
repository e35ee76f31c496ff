// `rungc explain FILE:LINE:COLUMN`: what is written there, in the program that the file belongs to.
#pragma once
#include <optional>
#include <string>

namespace rung::rungc {

struct SourcePlace {
  std::string file;
  uint32_t line = 0;   // from 1
  uint32_t column = 0; // from 1, in characters
};

// Of a word of that form that names a file; nothing for any other.
std::optional<SourcePlace> sourcePlace(const std::string& word);

// What an operand or a declared name at the place is and who uses it, also where the program has errors: these are not
// reported. Else the word that is written there, for the reference. Nothing, and `status` says why, where the place
// cannot be had.
struct Explained {
  std::string text; // empty: look the word up
  std::string word;
};
std::optional<Explained> explainPlace(const SourcePlace& place, int& status);

} // namespace rung::rungc
