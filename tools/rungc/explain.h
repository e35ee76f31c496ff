// Output of rungc explain: entries of the reference, the meaning of a position in a source, names of a project.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "compiler/reference.h"

namespace rung::rungc {

// The argument of `rungc explain FILE:LINE:COLUMN`.
struct SourcePlace {
  std::string file;
  uint32_t line = 0;   // from 1
  uint32_t column = 0; // from 1, in characters
};

// Parses a word of that form; nothing for any other word.
std::optional<SourcePlace> sourcePlace(const std::string& word);

// What the operand or declared name at the position is and which rungs use it, also if the program has errors: these
// are not reported. Otherwise the reference entry of the word there, or that it is a comment, a title, a wire or blank.
// On failure nothing, and `status` says why.
std::optional<std::string> explainPlace(const SourcePlace& place, int& status);

// What a word is in a project.
struct ProjectNames {
  const frontend::Dialect* dialect = nullptr;
  std::string text; // description of the name or address; "": unknown, or there is no project
  std::vector<compiler::ReferenceEntry> entries;
  bool hasErrors = false; // the program has errors, so only its names are known
};
// Looks in the project of --project, else of the working directory; mistakes in its program are not reported. Nothing
// if there is no project or it cannot be read, which is reported for --project only.
std::optional<ProjectNames> namesOfProject(const std::string& word, const std::string& projectFile);

} // namespace rung::rungc
