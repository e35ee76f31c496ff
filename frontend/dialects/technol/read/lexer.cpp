// The lexer of TECHNOL.
#include "frontend/dialects/technol/read/lexer.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "frontend/sema/foreign_word.h"
#include "frontend/syntax/word_lexer.h"
#include "ir/support/diag/source.h"
#include "ir/support/diag/technol.h"
#include "ir/support/utf8.h"
#include "rtlib/nc/technol/code_page.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::frontend::technol {
namespace {

bool isNameChar(char c) { return text::isLetter(c) || text::isDigit(c) || c == '_' || c == '?' || c == '@'; }
bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\f'; }
bool isHexDigit(char c) { return text::hexDigit(c) >= 0; }
bool isPunct(char c) { return std::string_view(":,.+-()[]$<>").find(c) != std::string_view::npos; }

// End of the number that begins at `first`.
size_t numberEnd(std::string_view text, size_t first) {
  size_t i = first;
  while (i < text.size() && text::isDigit(text[i])) ++i;
  const bool point = i + 1 < text.size() && text[i] == '.' && text::isDigit(text[i + 1]);
  if (!point) {
    while (i < text.size() && isNameChar(text[i])) ++i;
    return i;
  }
  ++i;
  while (i < text.size() && text::isDigit(text[i])) ++i;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    size_t e = i + 1;
    if (e < text.size() && (text[e] == '+' || text[e] == '-')) ++e;
    if (e < text.size() && text::isDigit(text[e])) {
      i = e;
      while (i < text.size() && text::isDigit(text[i])) ++i;
    }
  }
  // 1.5X and 1.2.3 are each one bad number.
  while (i < text.size() &&
         (isNameChar(text[i]) || (text[i] == '.' && i + 1 < text.size() && text::isDigit(text[i + 1]))))
    ++i;
  return i;
}

// End of a run of characters that are not blank or punctuation and do not begin a text or a comment.
size_t wordEnd(std::string_view text, size_t first) {
  size_t i = first;
  while (i < text.size() && !isBlank(text[i]) && !isPunct(text[i]) && text[i] != ';' && text[i] != '\'') ++i;
  return i;
}

// Explains how a number of another language is written here; false if the word is not one.
bool noteNumber(std::string_view word, SourceRange range, DiagBuilder& report) {
  const std::optional<ForeignNumber> number = foreignNumber(word);
  if (!number) return false;
  const bool isHex = number->base == 16;
  const std::string here =
      (isHex && !text::isDigit(number->digits[0]) ? "0" : "") + std::string(number->digits) + (isHex ? "h" : "b");
  if (parseNumber(here)) report.meant(range, here);
  return true;
}

// Explains a comment, a number, an address or a negation of another language, or a letter of another alphabet.
void noteForeign(const SourceLine& line, size_t first, size_t last, DiagBuilder& report) {
  const std::string_view word = line.text.substr(first, last - first);
  const bool isNegated = word.size() > 1 && (word[0] == '/' || word[0] == '!' || word[0] == '~') && isNameChar(word[1]);
  if (noteNumber(word, line.range(first, last), report)) return;
  if (word[0] == '#' && std::ranges::all_of(word.substr(1), isHexDigit) && word.size() > 1)
    report.note("a number has no '#'; a hexadecimal one ends with an h: " + std::string(word.substr(1)) + "h");
  else if (word.starts_with("//") || word.starts_with("/*") || word == "#")
    report.note("a comment begins with ';'");
  else if (isNegated)
    report.note("a bit is negated by a '-': -" + std::string(word.substr(1)));
  else if (word == "=")
    report.note("WR writes a result, STO a value");
  else if (word.starts_with('%'))
    report.note("bits and variables have names here, which DFM and DS declare, and no addresses");
  else if (word.starts_with('|'))
    report.note("this is a line of a drawing, and TECHNOL programs are lists: LDR A, LA B, WR C");
  const auto* const other = std::ranges::find_if(word, [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
  if (other != word.end())
    noteLookAlike(line.text, first + static_cast<size_t>(other - word.begin()), line.begin, report);
}

void reportWord(const SourceLine& line, size_t first, size_t last, Diagnostics& diagnostics) {
  if (line.text.substr(first).starts_with("#$")) // a number of another language; other words end at a `$`
    for (last = first + 2; last < line.text.size() && isNameChar(line.text[last]);) ++last;
  const std::string_view word = line.text.substr(first, last - first);
  for (char c : word)
    if (isNameChar(c)) {
      DiagBuilder report = diagnostics.report(diag::BadIdentifier, line.range(first, last));
      report << word;
      if (word.starts_with('"')) report.note("a text is written between apostrophes: 'abc'");
      noteForeign(line, first, last, report);
      return;
    }
  DiagBuilder report = diagnostics.report(diag::BadCharacter, line.range(first, last));
  report << "'" + std::string(word) + "'";
  noteForeign(line, first, last, report);
}

} // namespace

size_t commentOf(std::string_view line) {
  bool quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\'') quoted = !quoted;
    if (line[i] == ';' && !quoted) return i;
  }
  return std::string_view::npos;
}

bool tokenize(const SourceLine& line, std::vector<Token>& out, Diagnostics& diagnostics) {
  const std::string_view text = line.text;
  for (size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (isBlank(c)) {
      ++i;
      continue;
    }
    if (c == ';') return true;
    if (c == '\'') {
      const size_t close = text.find('\'', i + 1);
      if (close == std::string_view::npos) {
        diagnostics.report(diag::BadString, line.range(i, text.size()));
        return false;
      }
      out.push_back({text.substr(i + 1, close - i - 1), line.at(i), TokenKind::Text});
      i = close + 1;
      continue;
    }
    if (isPunct(c)) {
      out.push_back({text.substr(i, 1), line.at(i), TokenKind::Punct});
      ++i;
      continue;
    }
    size_t end = i;
    if (text::isDigit(c)) {
      end = numberEnd(text, i);
    } else {
      while (end < text.size() && isNameChar(text[end])) ++end;
    }
    const size_t word = wordEnd(text, i);
    if (end < word && (end == i || !isPunct(text[end]))) {
      reportWord(line, i, word, diagnostics);
      return false;
    }
    out.push_back({text.substr(i, end - i), line.at(i), text::isDigit(c) ? TokenKind::Number : TokenKind::Name});
    i = end;
  }
  return true;
}

namespace {

std::optional<Number> parseRadix(std::string_view digits, int radix) {
  const auto value = text::numberIn<uint64_t>(digits, radix);
  if (!value) return std::nullopt;
  return Number{.value = static_cast<int64_t>(*value)};
}

} // namespace

// Whether the text is a number of valid digits that exceeds 64 bits.
static bool isTooLarge(std::string_view text) {
  const char last = text.empty() ? ' ' : text::upper(text.back());
  const int base = last == 'H' ? 16 : last == 'B' ? 2 : 10;
  const std::string_view digits = base == 10 ? text : text.substr(0, text.size() - 1);
  return !digits.empty() && !parseNumber(text) &&
         std::ranges::all_of(digits, [&](char c) { return text::hexDigit(c) >= 0 && text::hexDigit(c) < base; });
}

std::optional<Number> parseNumber(std::string_view text) {
  if (text.empty() || !text::isDigit(text[0])) return std::nullopt;
  if (text.find('.') != std::string_view::npos) {
    const auto real = text::numberIn<double>(text);
    return real ? std::optional(Number{.isReal = true, .real = *real}) : std::nullopt;
  }
  const char last = text::upper(text.back());
  if (last == 'H') return parseRadix(text.substr(0, text.size() - 1), 16);
  if (last == 'B') return parseRadix(text.substr(0, text.size() - 1), 2);
  return parseRadix(text, 10);
}

void reportBadNumber(const Token& token, std::string_view written, Diagnostics& diagnostics) {
  const std::string_view number = token.text;
  if (written == number && isTooLarge(number)) {
    diagnostics.report(diag::OperandRange, token.range()) << number << "what 64 bits hold";
    return;
  }
  DiagBuilder report = diagnostics.report(diag::BadNumber, token.range());
  report << written;
  if (written != number || noteNumber(number, token.range(), report)) return;
  if (std::ranges::all_of(number, isHexDigit))
    report.note("a hexadecimal number ends with an h: " + std::string(number) + "h");
}

bool reportForeignNumber(std::span<const Token> tokens, Diagnostics& diagnostics) {
  if (tokens.size() < 2 || !tokens[0].is('$') || tokens[0].text.data() + 1 != tokens[1].text.data()) return false;
  const Token both{{tokens[0].text.data(), tokens[1].text.size() + 1}, tokens[0].pos, TokenKind::Number};
  if (!foreignNumber(both.text)) return false;
  reportBadNumber(both, both.text, diagnostics);
  return true;
}

// Encodings of source files.

std::optional<FileId> readable(SourceManager& sources, FileId file, Diagnostics& diagnostics) {
  const std::string_view text = sources.text(file);
  const bool binary = text.find('\0') != std::string_view::npos;
  if (binary || sources.hasEncoding(file) || findInvalidUtf8(text) == std::string_view::npos)
    return checkEncoding(sources, file, diagnostics) ? std::optional(file) : std::nullopt;
  return sources.addBuffer(std::string(sources.name(file)), nc::utf8From(nc::guessCodePage(text), text));
}

std::optional<uint8_t> characterByte(std::string_view text) {
  if (text.empty() || countCodePoints(text) != 1) return std::nullopt;
  const CodePoint character = decodeUtf8(text, 0);
  return character.valid && character.length == text.size() ? nc::windows1250Of(character.value) : std::nullopt;
}

bool checkCharacters(const Token& text, Diagnostics& diagnostics) {
  bool good = true;
  for (size_t at = 0; at < text.text.size();) {
    const CodePoint character = decodeUtf8(text.text, at);
    const uint32_t begin = text.pos.value + 1 + static_cast<uint32_t>(at); // after the apostrophe
    const auto end = static_cast<uint32_t>(begin + character.length);
    const std::string_view written = text.text.substr(at, character.length);
    at += character.length;
    if (nc::windows1250Of(character.value)) continue;
    good = false;
    const SourceRange place = text.written == 0 ? SourceRange{{begin}, {end}} : text.range();
    diagnostics.report(diag::TextCharacter, place) << fmt::format("U+{:04X} '{}'", character.value, written);
  }
  return good;
}

std::string memoryText(const Token& text, Diagnostics& diagnostics) {
  checkCharacters(text, diagnostics);
  return nc::memoryText(text.text);
}

} // namespace rung::frontend::technol
