// Encodings of sources (see encoding.h).
#include "frontend/dialects/technol/read/encoding.h"

#include "frontend/syntax/word_lexer.h"
#include "ir/support/utf8.h"
#include "rtlib/nc/technol/code_page.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::technol {
std::string_view withoutEndMark(std::string_view text) {
  constexpr char kEndOfFile = 0x1A;
  const size_t last = text.find_last_not_of("\r\n");
  return last != std::string_view::npos && text[last] == kEndOfFile ? text.substr(0, last) : text;
}

Encoding encodingNamed(std::string_view name) {
  if (text::equalsIgnoringCase(name, "UTF-8")) return Encoding::Utf8;
  if (text::equalsIgnoringCase(name, "WINDOWS-1250")) return Encoding::Windows1250;
  if (text::equalsIgnoringCase(name, "CP852")) return Encoding::Cp852;
  return Encoding::Detect;
}

std::optional<FileId> readable(SourceManager& sources, FileId file, Encoding encoding, Diagnostics& diagnostics) {
  const std::string_view whole = sources.text(file), text = withoutEndMark(whole);
  const bool binary = text.find('\0') != std::string_view::npos;
  if (encoding == Encoding::Detect && findInvalidUtf8(text) == std::string_view::npos) encoding = Encoding::Utf8;
  if (binary || encoding == Encoding::Utf8) {
    if (!checkEncoding(sources, file, diagnostics)) return std::nullopt;
    return text.size() == whole.size() ? file : sources.addBuffer(std::string(sources.name(file)), std::string(text));
  }
  nc::CodePage page = encoding == Encoding::Cp852 ? nc::CodePage::Cp852 : nc::CodePage::Windows1250;
  if (encoding == Encoding::Detect) page = nc::guessCodePage(text);
  return sources.addBuffer(std::string(sources.name(file)), nc::utf8From(page, text));
}

std::optional<uint8_t> characterByte(std::string_view text) {
  if (text.empty() || countCodePoints(text) != 1) return std::nullopt;
  const CodePoint character = decodeUtf8(text, 0);
  return character.valid && character.length == text.size() ? nc::windows1250Of(character.value) : std::nullopt;
}

} // namespace rung::frontend::technol
