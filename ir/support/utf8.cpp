// UTF-8 by utf8proc, which decodes according to RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF.
#include "ir/support/utf8.h"

#include <algorithm>
#include <cstring>

#include <utf8proc.h>

#include "rtlib/text/utf8.h"

namespace rung {

size_t countCodePoints(std::string_view text) {
  return text.size() - static_cast<size_t>(std::count_if(text.begin(), text.end(), rung::text::isUtf8Continuation));
}

CodePoint decodeUtf8(std::string_view text, size_t offset) {
  const auto* bytes = reinterpret_cast<const utf8proc_uint8_t*>(text.data()) + offset;
  utf8proc_int32_t value = 0;
  const utf8proc_ssize_t length = utf8proc_iterate(bytes, static_cast<utf8proc_ssize_t>(text.size() - offset), &value);
  if (length <= 0) return {*bytes, 1, false};
  return {static_cast<uint32_t>(value), static_cast<uint8_t>(length), true};
}

size_t findInvalidUtf8(std::string_view text) {
  size_t offset = 0;
  while (offset < text.size()) {
    // Sources are mostly ASCII, which is read eight bytes at a time.
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
  return static_cast<unsigned>(utf8proc_charwidth(static_cast<utf8proc_int32_t>(codePoint)));
}

} // namespace rung
