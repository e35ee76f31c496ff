// Names and bytes as scenarios write them.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "rtlib/text/letters.h"

namespace rung::sim::technol {

// `prefix` in any case at the beginning of the text, which loses it.
inline bool takePrefix(std::string_view& text, std::string_view prefix) {
  if (!text::equalsIgnoringCase(text.substr(0, prefix.size()), prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

// "0102FF".
inline std::string hexOf(std::span<const uint8_t> bytes) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text;
  for (const uint8_t byte : bytes) text += {kDigits[byte >> 4], kDigits[byte & 15]};
  return text;
}

} // namespace rung::sim::technol
