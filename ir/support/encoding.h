// Conversion of text in encodings other than UTF-8, by iconv.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace rung {

/// Whether iconv has an encoding of this name, such as gb18030 or windows-1250.
bool knowsEncoding(const std::string& name);

struct Decoded {
  std::string text;            ///< UTF-8; if there is a wrong byte, the text before it
  std::optional<size_t> wrong; ///< offset of the first byte that does not begin a character
};

/// `encoding` must be known.
Decoded decoded(std::string_view bytes, const std::string& encoding);

/// The bytes of a text in UTF-8; nothing if the encoding lacks one of its characters. `encoding` must be known.
std::optional<std::string> encoded(std::string_view text, const std::string& encoding);

/// The encoding of a text that shows it by itself: UTF-16, with a byte order mark or, low byte first, without;
/// otherwise "".
std::string shownEncoding(std::string_view bytes);

/// The encoding of a text that does not declare it, as LADDER-III and FANUC's controls write it: the one that it shows,
/// UTF-8, or ISO-8859-1 (Latin-1) for all other bytes. For decoded().
std::string guessedEncoding(std::string_view bytes);

/// The encoding that a text declares: `; encoding: NAME` alone on its first or second line.
struct EncodingLine {
  std::string name;
  size_t offset = 0; ///< of the name
};
std::optional<EncodingLine> encodingLine(std::string_view bytes);

} // namespace rung
