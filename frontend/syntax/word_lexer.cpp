// Splits source text into lines, words and comments (see word_lexer.h).
#include "frontend/syntax/word_lexer.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "ir/support/diag/source.h"
#include "ir/support/utf8.h"
#include "rtlib/text/blanks.h"

namespace rung::frontend {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t'; }

bool contains(std::string_view set, char c) { return set.find(c) != std::string_view::npos; }

/// End of a plain word that begins at `begin`.
size_t wordEnd(std::string_view text, size_t begin, const WordRules& rules) {
  size_t end = begin;
  while (end < text.size() && !isBlank(text[end]) && text[end] != rules.comment && !contains(rules.quotes, text[end]) &&
         !contains(rules.separators, text[end])) {
    ++end;
  }
  return end;
}

} // namespace

LineReader::LineReader(const SourceManager& sources, FileId file)
    : text_(sources.text(file)), begin_(sources.position(file, 0)) {
  if (text_.starts_with(kByteOrderMark)) offset_ = kByteOrderMark.size();
}

bool LineReader::next(SourceLine& line) {
  if (offset_ >= text_.size()) return false;
  const size_t newline = text_.find('\n', offset_);
  size_t end = newline == std::string_view::npos ? text_.size() : newline;
  const size_t following = newline == std::string_view::npos ? end : newline + 1;
  if (end > offset_ && text_[end - 1] == '\r') --end;
  line.number = ++number_;
  line.text = text_.substr(offset_, end - offset_);
  line.begin = {begin_.value + static_cast<uint32_t>(offset_)};
  offset_ = following;
  return true;
}

void splitWords(const SourceLine& line, const WordRules& rules, LineWords& out) {
  out.words.clear();
  out.hasComment = false;
  out.comment = {};
  out.commentRange = {};
  out.unterminatedQuote = false;
  const std::string_view text = line.text;
  size_t at = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (isBlank(c)) {
      ++at;
    } else if (c == rules.comment) {
      out.hasComment = true;
      out.comment = text::trimmed(text.substr(at + 1));
      out.commentRange = line.range(at, text.size());
      return;
    } else if (contains(rules.quotes, c)) {
      const size_t close = text.find(c, at + 1);
      const bool closed = close != std::string_view::npos;
      const size_t textEnd = closed ? close : text.size();
      const size_t end = closed ? close + 1 : textEnd;
      out.words.push_back({text.substr(at + 1, textEnd - at - 1), line.range(at, end), true});
      out.unterminatedQuote = !closed;
      at = end;
    } else {
      const size_t end = contains(rules.separators, c) ? at + 1 : wordEnd(text, at, rules);
      out.words.push_back({text.substr(at, end - at), line.range(at, end), false});
      at = end;
    }
  }
}

bool checkEncoding(const SourceManager& sources, FileId file, Diagnostics& diagnostics) {
  const std::string_view text = sources.text(file);
  const std::optional<SourceManager::Undecoded>& undecoded = sources.undecoded(file);
  if (undecoded && !undecoded->known) {
    const size_t first = undecoded->offset;
    diagnostics.report(diag::UnknownEncoding, sources.range(file, first, first + undecoded->encoding.size()))
        << undecoded->encoding;
    return false;
  }
  const size_t offset = undecoded ? undecoded->offset : std::min(findInvalidUtf8(text), text.find('\0'));
  if (offset == std::string_view::npos) return true;
  DiagBuilder report = diagnostics.report(diag::BadEncoding, sources.range(file, offset, offset + 1));
  report << fmt::format("0x{:02X}", static_cast<unsigned char>(text[offset]))
         << (undecoded ? undecoded->encoding : "UTF-8");
  if (!undecoded && (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")))
    report.note("it begins as UTF-16 does: `encoding = \"utf-16\"` in the project file says so");
  else if (!undecoded && text[offset] != '\0')
    report.note(
        "a file in another encoding names it in its first line, for instance `; encoding: windows-1250`; or the "
        "project file does, `encoding = \"windows-1250\"`");
  return false;
}

// Characters outside the language, and the ASCII characters that they resemble.

namespace {

struct LookAlike {
  uint32_t character;
  char ascii;
};
// Greek and Cyrillic letters, and the quotation marks and signs that word processors insert.
constexpr LookAlike kLookAlikes[] = {
    {0x00A0, ' '},  {0x00D7, '*'}, {0x0391, 'A'}, {0x0392, 'B'}, {0x0395, 'E'}, {0x0396, 'Z'}, {0x0397, 'H'},
    {0x0399, 'I'},  {0x039A, 'K'}, {0x039C, 'M'}, {0x039D, 'N'}, {0x039F, 'O'}, {0x03A1, 'P'}, {0x03A4, 'T'},
    {0x03A5, 'Y'},  {0x03A7, 'X'}, {0x03BF, 'o'}, {0x0405, 'S'}, {0x0406, 'I'}, {0x0408, 'J'}, {0x0410, 'A'},
    {0x0412, 'B'},  {0x0415, 'E'}, {0x041A, 'K'}, {0x041C, 'M'}, {0x041D, 'H'}, {0x041E, 'O'}, {0x0420, 'P'},
    {0x0421, 'C'},  {0x0422, 'T'}, {0x0425, 'X'}, {0x0430, 'a'}, {0x0435, 'e'}, {0x043E, 'o'}, {0x0440, 'p'},
    {0x0441, 'c'},  {0x0443, 'y'}, {0x0445, 'x'}, {0x0455, 's'}, {0x0456, 'i'}, {0x0458, 'j'}, {0x2018, '\''},
    {0x2019, '\''}, {0x202F, ' '}, {0x2212, '-'}, {0x3000, ' '},
};

/// The ASCII character that this one resembles; 0 if there is none.
char asciiFor(uint32_t character) {
  if (character >= 0xFF01 && character <= 0xFF5E) return static_cast<char>(character - 0xFF01 + '!'); // full width
  if (character >= 0x2010 && character <= 0x2015) return '-';
  if (character >= 0x201C && character <= 0x201F) return '"';
  const auto* const found = std::ranges::find(kLookAlikes, character, &LookAlike::character);
  return found == std::end(kLookAlikes) ? '\0' : found->ascii;
}

} // namespace

void reportBadCharacter(std::string_view text, size_t offset, SourcePos begin, Diagnostics& diagnostics) {
  const CodePoint character = decodeUtf8(text, offset);
  const uint32_t at = begin.value + static_cast<uint32_t>(offset);
  std::string name = fmt::format("U+{:04X}", character.value);
  if (character.value > 0x20) name += fmt::format(" '{}'", text.substr(offset, character.length));
  DiagBuilder report = diagnostics.report(diag::BadCharacter, {{at}, {at + character.length}});
  report << name;
  if (character.valid && character.value >= 0xC0 && asciiFor(character.value) == '\0')
    report.note("outside comments and quoted texts a program is ASCII, its names too");
  noteLookAlike(text, offset, begin, report);
}

void noteLookAlike(std::string_view text, size_t offset, SourcePos begin, DiagBuilder& report) {
  const CodePoint character = decodeUtf8(text, offset);
  const char ascii = asciiFor(character.value);
  if (ascii == '\0') return;
  const uint32_t at = begin.value + static_cast<uint32_t>(offset);
  report.note(ascii == ' ' ? std::string("it only looks like a blank")
                           : fmt::format("'{}' only looks like '{}'", text.substr(offset, character.length), ascii));
  report.fix({{at}, {at + character.length}}, {&ascii, 1});
}

} // namespace rung::frontend
