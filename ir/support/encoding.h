// Text in other encodings than UTF-8, by iconv.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace rung {

/// Whether iconv knows an encoding of this name, such as gb18030 or windows-1250.
bool knowsEncoding(const std::string& name);

struct Decoded {
  std::string text;            ///< UTF-8; what comes before the wrong byte where there is one
  std::optional<size_t> wrong; ///< offset of the first byte that begins no character
};

/// `encoding` is known.
Decoded decoded(std::string_view bytes, const std::string& encoding);

/// The bytes of a text in UTF-8; nothing where the encoding lacks one of its characters. `encoding` is known.
std::optional<std::string> encoded(std::string_view text, const std::string& encoding);

/// What a text says of itself: `; encoding: NAME` alone on its first or second line.
struct EncodingLine {
  std::string name;
  size_t offset = 0; ///< of the name
};
std::optional<EncodingLine> encodingLine(std::string_view bytes);

} // namespace rung
