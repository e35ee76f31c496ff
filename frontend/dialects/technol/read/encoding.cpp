// Encodings of sources (see encoding.h).
#include "frontend/dialects/technol/read/encoding.h"

#include <fmt/format.h>

#include "frontend/syntax/word_lexer.h"
#include "ir/support/diag/technol.h"
#include "ir/support/utf8.h"
#include "rtlib/nc/technol/code_page.h"

namespace rung::frontend::technol {

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
