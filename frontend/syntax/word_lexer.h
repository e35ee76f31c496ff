// Splits a line into words: the lexer for all languages with one statement per line. Words are separated by blanks and
// tabs; a comment runs to the end of the line; a quoted text is one word. Nothing is reported here: the caller knows
// what its language forbids (see LineWords for what it needs to decide).
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::frontend {

struct Word {
  std::string_view text; ///< without the quotes when quoted
  SourceRange range;     ///< with the quotes when quoted
  bool quoted = false;
};

/// One line of a file, without its line end (LF or CR LF).
struct SourceLine {
  uint32_t number = 0; ///< from 1
  std::string_view text;
  SourcePos begin;

  SourcePos at(size_t offset) const { return {begin.value + static_cast<uint32_t>(offset)}; }
  SourceRange range(size_t first, size_t last) const { return {at(first), at(last)}; }
  SourceRange range() const { return range(0, text.size()); }
};

/// Iterates over the lines of a file: `while (lines.next(line))`. A line end at the end of the file opens no further
/// line. A byte order mark at the beginning of the file is skipped.
class LineReader {
public:
  LineReader(const SourceManager& sources, FileId file);
  bool next(SourceLine& line);

private:
  std::string_view text_;
  SourcePos begin_;
  size_t offset_ = 0;
  uint32_t number_ = 0;
};

struct WordRules {
  char comment = ';';
  std::string_view quotes = "\""; ///< every character of it opens and closes a text
  std::string_view separators;    ///< each of these characters is a separate word, e.g. ",:"
};

struct LineWords {
  std::vector<Word> words;
  bool hasComment = false;
  std::string_view comment; ///< after the comment character, blanks at both ends removed
  SourceRange commentRange; ///< with the comment character
  /// Set if a text is not closed on the line; it is then the last word and reaches to the end of the line.
  bool unterminatedQuote = false;
};

/// Splits a line. The result is reused: pass the same LineWords for every line.
void splitWords(const SourceLine& line, const WordRules& rules, LineWords& out);

/// Reports bad-encoding at the first byte that is not UTF-8 (or is NUL: not a text at all) and then returns false.
bool checkEncoding(const SourceManager& sources, FileId file, Diagnostics& diagnostics);

// Characters without meaning outside of comments and texts.

/// Reports the character at `offset` of a text that begins at `begin`. One that only looks like an ASCII character (of
/// another alphabet, of a word processor, full width) gets a fix.
void reportBadCharacter(std::string_view text, size_t offset, SourcePos begin, Diagnostics& diagnostics);

/// Adds the look-alike's part of the report, if the character is one.
void noteLookAlike(std::string_view text, size_t offset, SourcePos begin, DiagBuilder& report);

} // namespace rung::frontend
