// Tokens of a TECHNOL line. Names keep their spelling; they are compared without case everywhere (see symbols.h). A
// name consists of letters, digits and `_ ? @` (man. l.18-27); a number begins with a digit and includes following
// letters, so that 0F8H is one token; it includes a point only between decimal digits, so that BUN+3.ALFA keeps its
// point.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/syntax/word_lexer.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::frontend::technol {

enum class TokenKind : uint8_t { Name, Number, Text, Punct };

struct Token {
  std::string_view text; // for a Text, without its apostrophes
  SourcePos pos;
  TokenKind kind = TokenKind::Name;
  uint32_t written = 0; // number of characters in the source, if the text is different

  bool is(char c) const { return kind == TokenKind::Punct && text[0] == c; }
  SourceRange range() const {
    const uint32_t quotes = kind == TokenKind::Text ? 2 : 0;
    const uint32_t length = written != 0 ? written : static_cast<uint32_t>(text.size()) + quotes;
    return {pos, {pos.value + length}};
  }
};

// Appends the tokens of a line without its comment. False after a report (bad-character, bad-identifier, bad-string).
bool tokenize(const SourceLine& line, std::vector<Token>& out, Diagnostics& diagnostics);

// Offset of the comment's `;` in a line, or npos.
size_t commentOf(std::string_view line);

struct Number {
  bool isReal = false;
  int64_t value = 0;
  double real = 0;
};

// Decimal, 0F8H, 0101b or a real; nothing for any other text or a value that exceeds 64 bits.
std::optional<Number> parseNumber(std::string_view text);
// For a token; `written` includes the characters that belong to it. Adds how the number is written here if it is in the
// form of another language.
void reportBadNumber(const Token& token, std::string_view written, Diagnostics& diagnostics);
// The same for $1F, which is two tokens; false if these are something else.
bool reportForeignNumber(std::span<const Token> tokens, Diagnostics& diagnostics);

// Sources as UTF-8. A source that does not declare its encoding is UTF-8, Windows-1250 or CP852, as detected by its
// letters. A byte becomes one character, so that lines and columns do not change.

// The file itself, or a decoded copy of the same name. Nothing after a report (bad-encoding).
std::optional<FileId> readable(SourceManager& sources, FileId file, Diagnostics& diagnostics);

// The byte of a text of one character; nothing if it is not a single character of Windows-1250.
std::optional<uint8_t> characterByte(std::string_view text);

// Reports each character of a text that Windows-1250 lacks; true: none.
bool checkCharacters(const Token& text, Diagnostics& diagnostics);
// The text as stored in memory; reports as above.
std::string memoryText(const Token& text, Diagnostics& diagnostics);

} // namespace rung::frontend::technol
