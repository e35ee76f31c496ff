// The little of UTF-8 that sources and their display need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace rung {

/// What some editors begin a text in UTF-8 with.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Number of characters; a stray byte of a damaged text counts with the character before it.
size_t countCodePoints(std::string_view text);

struct CodePoint {
  uint32_t value = 0;
  uint8_t length = 1; ///< in bytes, at least 1
  bool valid = false; ///< false: one byte that begins no character
};

/// The character at offset, which must be inside the text.
CodePoint decodeUtf8(std::string_view text, size_t offset);

/// Offset of the first byte that is not UTF-8, npos when all is well.
size_t findInvalidUtf8(std::string_view text);

/// How many cells a terminal uses for a character: 2 for East Asian wide ones and emoji, 0 for combining marks and for
/// what is not printable, else 1.
unsigned displayWidth(uint32_t codePoint);

} // namespace rung
