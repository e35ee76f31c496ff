// What rungc explain prints: entries of the reference, what is written at a place of a source, names of a project.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/reference.h"

namespace rung::rungc {

// Entries of the reference as a terminal shows them: tables aligned, long cells over several lines, no marks of
// headings.
std::string plainText(std::string_view markdown);

// `rungc explain FILE:LINE:COLUMN`.
struct SourcePlace {
  std::string file;
  uint32_t line = 0;   // from 1
  uint32_t column = 0; // from 1, in characters
};

// Of a word of that form that names a file; nothing for any other.
std::optional<SourcePlace> sourcePlace(const std::string& word);

// What an operand or a declared name at the place is and who uses it, also where the program has errors: these are not
// reported. Else what the reference says of the word that is written there, or that it is a comment, a title, a wire, a
// blank. Nothing, and `status` says why, where the place cannot be had.
std::optional<std::string> explainPlace(const SourcePlace& place, int& status);

// Names of a project.
struct ProjectNames {
  std::string text; // what the word, a name or an address, is there; empty: nothing, or there is no project
  std::vector<compiler::ReferenceEntry> entries;
  bool hasErrors = false; // the program, of which only names are known then
};
// Of the project of --project, else of the working directory; mistakes of its program are not reported. Nothing where
// there is none or where it cannot be read, which is reported for --project alone.
std::optional<ProjectNames> namesOfProject(const std::string& word, const std::string& projectFile);

} // namespace rung::rungc
