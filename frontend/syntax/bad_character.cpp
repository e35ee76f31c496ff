// Characters that mean nothing, and those of ASCII that look like them.
#include "frontend/syntax/bad_character.h"

#include <algorithm>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "ir/support/diag/source.h"
#include "ir/support/utf8.h"

namespace rung::frontend {
namespace {

struct LookAlike {
  uint32_t character;
  char ascii;
};
// Greek and Cyrillic letters, quotation marks and signs of word processors.
constexpr LookAlike kLookAlikes[] = {
    {0x00A0, ' '},  {0x00D7, '*'}, {0x0391, 'A'}, {0x0392, 'B'}, {0x0395, 'E'}, {0x0396, 'Z'}, {0x0397, 'H'},
    {0x0399, 'I'},  {0x039A, 'K'}, {0x039C, 'M'}, {0x039D, 'N'}, {0x039F, 'O'}, {0x03A1, 'P'}, {0x03A4, 'T'},
    {0x03A5, 'Y'},  {0x03A7, 'X'}, {0x03BF, 'o'}, {0x0405, 'S'}, {0x0406, 'I'}, {0x0408, 'J'}, {0x0410, 'A'},
    {0x0412, 'B'},  {0x0415, 'E'}, {0x041A, 'K'}, {0x041C, 'M'}, {0x041D, 'H'}, {0x041E, 'O'}, {0x0420, 'P'},
    {0x0421, 'C'},  {0x0422, 'T'}, {0x0425, 'X'}, {0x0430, 'a'}, {0x0435, 'e'}, {0x043E, 'o'}, {0x0440, 'p'},
    {0x0441, 'c'},  {0x0443, 'y'}, {0x0445, 'x'}, {0x0455, 's'}, {0x0456, 'i'}, {0x0458, 'j'}, {0x2018, '\''},
    {0x2019, '\''}, {0x202F, ' '}, {0x2212, '-'}, {0x3000, ' '},
};

/// 0 for a character that is like none.
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
    report.note(
        "outside comments and quoted texts a program is ASCII: names have the letters A to Z and a to z, digits "
        "and _");
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
