// Encodings of sources (see encoding.h).
#include "frontend/dialects/technol/read/encoding.h"

#include "frontend/syntax/word_lexer.h"
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

} // namespace rung::frontend::technol
