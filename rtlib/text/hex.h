// Bytes in hexadecimal digits.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rung::text {

// "0102FF".
inline std::string hexOf(std::span<const uint8_t> bytes) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text;
  for (const uint8_t byte : bytes) text += {kDigits[byte >> 4], kDigits[byte & 15]};
  return text;
}

} // namespace rung::text
