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

// "01 02 FF".
inline std::string hexInPairs(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) {
    const auto value = static_cast<uint8_t>(byte);
    text += (text.empty() ? "" : " ") + hexOf({&value, 1});
  }
  return text;
}

// A number of at most eight bytes, most significant digit first.
inline std::string hexOfNumber(uint64_t number, uint32_t bytes) {
  uint8_t highFirst[8];
  for (uint32_t i = 0; i < bytes; ++i) highFirst[i] = static_cast<uint8_t>(number >> 8 * (bytes - 1 - i));
  return hexOf(std::span(highFirst).first(bytes));
}

} // namespace rung::text
