// What is written at a position of a program, for people: also if the program has errors.
#pragma once
#include <string>
#include <string_view>

#include "frontend/dialects/dialect.h"
#include "frontend/sema/analysis.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"
#include "tools/report/cross_reference.h"

namespace rung::source {

// A program after its check; everything must outlive it.
struct CheckedText {
  const SourceManager& sources;
  const frontend::Dialect& dialect;
  const frontend::Analysis& analysis;
  const Diagnostics& diagnostics;
  const report::CrossReference* reference = nullptr; // of a program without errors
};

// Each part is empty or ends with a line end.
struct Explanation {
  std::string errors;    // at the word, a line for each
  std::string reference; // entries of the reference, in Markdown
  std::string program;   // what the program has there, with the rungs that use it

  bool empty() const { return reference.empty() && program.empty(); }
};

// What the operand or declared name at the position is and which rungs use it. Otherwise the reference entry of the
// word there, or that it is a comment, a title, a wire or blank. The position must be one of a character of a line.
Explanation explain(const CheckedText& text, SourcePos at);

// A name of the program; ignores case if no name matches exactly; null: there is none.
const frontend::Definition* definitionOf(const frontend::Analysis& analysis, std::string_view name);
// What a name or an address is in the program; "" if it has neither.
std::string explainName(const CheckedText& text, const std::string& word);

// The length in bytes of a byte order mark at the beginning of the line.
size_t markLength(std::string_view line);
// What ends a name or an address of every dialect.
bool endsWord(char c);
// The word at one of the characters of a line: everything written there up to what ends words.
std::string_view wordAt(std::string_view line, size_t at);

} // namespace rung::source
