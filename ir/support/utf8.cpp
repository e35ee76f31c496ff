// Decoding as RFC 3629 has it: no overlong forms, no surrogates, nothing above U+10FFFF.
#include "ir/support/utf8.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace rung {
namespace {

/// Length that the first byte announces, 0 when it cannot be a first byte.
unsigned announcedLength(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return 2;
  if (first >= 0xE0 && first <= 0xEF) return 3;
  if (first >= 0xF0 && first <= 0xF4) return 4;
  return 0;
}

/// The least value that needs this many bytes.
constexpr uint32_t kLeastOfLength[] = {0, 0, 0x80, 0x800, 0x10000};

struct CharacterRange {
  uint32_t first;
  uint32_t last;
};

constexpr CharacterRange kCombining[] = {{0x0300, 0x036F}, {0x200B, 0x200F}, {0xFE00, 0xFE0F}, {0xFEFF, 0xFEFF}};
constexpr CharacterRange kWide[] = {{0x1100, 0x115F},   {0x2E80, 0x303E},  {0x3041, 0xA4CF}, {0xAC00, 0xD7A3},
                                    {0xF900, 0xFAFF},   {0xFE30, 0xFE6F},  {0xFF00, 0xFF60}, {0xFFE0, 0xFFE6},
                                    {0x1F300, 0x1FAFF}, {0x20000, 0x3FFFD}};

bool isIn(uint32_t value, const CharacterRange* begin, const CharacterRange* end) {
  return std::any_of(begin, end, [value](CharacterRange r) { return value >= r.first && value <= r.last; });
}

} // namespace

size_t countCodePoints(std::string_view text) {
  return text.size() - static_cast<size_t>(std::count_if(text.begin(), text.end(), isUtf8Continuation));
}

CodePoint decodeUtf8(std::string_view text, size_t offset) {
  const auto first = static_cast<unsigned char>(text[offset]);
  const unsigned length = announcedLength(first);
  if (length == 1) return {first, 1, true};
  if (length == 0 || offset + length > text.size()) return {first, 1, false};
  uint32_t value = first & (0x7Fu >> length);
  for (unsigned i = 1; i < length; ++i) {
    if (!isUtf8Continuation(text[offset + i])) return {first, 1, false};
    value = value << 6 | (static_cast<unsigned char>(text[offset + i]) & 0x3Fu);
  }
  const bool surrogate = value >= 0xD800 && value <= 0xDFFF;
  if (value < kLeastOfLength[length] || surrogate || value > 0x10FFFF) return {first, 1, false};
  return {value, static_cast<uint8_t>(length), true};
}

size_t findInvalidUtf8(std::string_view text) {
  size_t offset = 0;
  while (offset < text.size()) {
    // Sources are ASCII almost everywhere: eight bytes at a time.
    uint64_t word = 0;
    while (offset + sizeof word <= text.size()) {
      std::memcpy(&word, text.data() + offset, sizeof word);
      if (word & 0x8080808080808080u) break;
      offset += sizeof word;
    }
    if (offset == text.size()) break;
    const CodePoint character = decodeUtf8(text, offset);
    if (!character.valid) return offset;
    offset += character.length;
  }
  return std::string_view::npos;
}

unsigned displayWidth(uint32_t codePoint) {
  if (codePoint < 0x0300) return 1;
  if (isIn(codePoint, std::begin(kCombining), std::end(kCombining))) return 0;
  return isIn(codePoint, std::begin(kWide), std::end(kWide)) ? 2 : 1;
}

} // namespace rung
