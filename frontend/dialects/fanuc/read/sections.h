// The sections of a mnemonic file (inventory §1.2): each begins with its code, `%@3`, and ends with a line that is `%`.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "frontend/syntax/word_lexer.h"
#include "ir/support/source.h"

namespace rung::frontend::fanuc {

inline constexpr std::string_view kParametersCode = "%@0";
inline constexpr std::string_view kTitleCode = "%@1";

struct Section {
  enum class Kind : uint8_t { Parameters, Title, Symbols, SymbolTable, Ladder, Messages, Modules, Unknown, Outside };
  Kind kind = Kind::Unknown; // Outside: text between sections or after the last one
  std::string_view code;     // such as "%@2-C"
  SourceRange range;         // of the line with the code; of Outside its first line
  uint32_t first = 0;        // its lines, without those with its code and its end: first to last - 1
  uint32_t last = 0;
  bool isClosed = true; // by a line that is %

  // The code without the columns of a table.
  std::string_view name() const { return code.substr(0, code.find_first_of("( \t")); }
};

struct FileSections {
  std::vector<Section> list;
  bool begins = false; // with %@A
  bool ends = false;   // with %@E
};

inline bool hasSymbols(const Section& section) {
  return section.kind == Section::Kind::Symbols || section.kind == Section::Kind::SymbolTable;
}

// A file without any code is one section of ladder. The text before the first code is a comment.
FileSections sectionsOf(const SourceManager& sources, FileId file);

// A line of a file, without blanks and CR at its end.
SourceLine lineOf(const SourceManager& sources, FileId file, uint32_t number);
// Calls take(line) for each line of a section.
template <class Take>
void eachLine(const SourceManager& sources, FileId file, const Section& section, Take take) {
  for (uint32_t number = section.first; number < section.last; ++number) take(lineOf(sources, file, number));
}

} // namespace rung::frontend::fanuc
