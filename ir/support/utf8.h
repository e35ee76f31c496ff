// The operations on UTF-8 that sources and their display need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace rung {

/// Begins a UTF-8 text of some editors.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Number of characters; an invalid byte counts with the character before it.
size_t countCodePoints(std::string_view text);

struct CodePoint {
  uint32_t value = 0;
  uint8_t length = 1; ///< in bytes, at least 1
  bool valid = false; ///< false: one byte that does not begin a character
};

/// The character at offset, which must be inside the text.
CodePoint decodeUtf8(std::string_view text, size_t offset);

/// Offset of the first byte that is not valid UTF-8, npos if there is none.
size_t findInvalidUtf8(std::string_view text);

/// The columns of a terminal that a character takes: 2 for East Asian wide characters and emoji, 0 for combining marks
/// and unprintable characters, otherwise 1.
unsigned displayWidth(uint32_t codePoint);

} // namespace rung
