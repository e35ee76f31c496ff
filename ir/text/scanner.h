// Reads words, numbers and texts of the text form, character by character. After the first error it is at the end of
// the text and returns empty results, so that callers need not check every step.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "ir/text/text.h"

namespace rung::ir {

class Scanner {
public:
  explicit Scanner(std::string_view text) : text_(text) {}

  bool ok() const { return message_.empty(); }
  // Records the first error, at the latest token.
  void fail(std::string message);
  // The recorded error with its line and column.
  ParseError error() const;

  // Whether the next character of the line is `c`; `accept` also consumes it.
  bool peek(char c);
  bool accept(char c);
  void expect(char c);
  // Consumes the next word of the line if it is `word`; false otherwise.
  bool acceptWord(std::string_view word);
  void expectWord(std::string_view word);

  bool peekName(); // whether a word or a text comes next
  bool peekNumber();
  std::string_view word();
  std::string name(); // a word or a text
  std::string text();
  uint64_t u64();
  uint32_t u32();
  int64_t i64(); // a minus sign is allowed; values above INT64_MAX wrap
  double real();
  std::string_view hexDigits();

  // Consumes the end of a line, and all empty lines after it.
  void endLine();
  bool atEnd();

private:
  void skipBlanks(); // and a comment
  void skipEmptyLines();
  bool more() const { return pos_ < text_.size(); }

  std::string_view text_;
  size_t pos_ = 0;
  size_t token_ = 0; // where the latest token begins
  size_t errorAt_ = 0;
  std::string message_;
};

} // namespace rung::ir
