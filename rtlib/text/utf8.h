// The boundaries of UTF-8 characters.
#pragma once
#include <cstddef>
#include <string_view>

namespace rung::text {

// Whether the byte continues a character (10xxxxxx).
constexpr bool isUtf8Continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u; }

// The longest prefix of whole characters that fits in `bytes` bytes.
constexpr std::string_view wholeCharacters(std::string_view text, size_t bytes) {
  if (text.size() <= bytes) return text;
  while (bytes > 0 && isUtf8Continuation(text[bytes])) --bytes;
  return text.substr(0, bytes);
}

} // namespace rung::text
