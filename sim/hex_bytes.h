// Bytes in scenarios: "02 55".
#pragma once
#include <optional>
#include <string_view>

#include "rtlib/text/letters.h"

namespace rung::sim {

// Parses pairs of hexadecimal digits, with or without blanks between them, to a string or a vector of bytes; nothing if
// the text is something else.
template <class Bytes>
std::optional<Bytes> bytesOfHex(std::string_view text) {
  Bytes bytes;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == ' ') continue;
    const int high = text::hexDigit(text[i]), low = i + 1 < text.size() ? text::hexDigit(text[i + 1]) : -1;
    if (high < 0 || low < 0) return std::nullopt;
    bytes.push_back(static_cast<typename Bytes::value_type>(high * 16 + low));
    ++i;
  }
  return bytes;
}

} // namespace rung::sim
