// Control characters of ASCII: what is quoted must do nothing to a terminal, and make no lines of its own in a log.
#pragma once
#include <algorithm>
#include <string>
#include <string_view>

namespace rung::text {

constexpr bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

constexpr bool hasControls(std::string_view text) { return std::ranges::any_of(text, isControl); }

// "\x1b" in the place of ESC; the characters `kept`, such as "\n", stay.
inline std::string withoutControls(std::string_view text, std::string_view kept = "") {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (!isControl(c) || kept.find(c) != std::string_view::npos)
      result += c;
    else
      result.append("\\x") += {kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return result;
}

} // namespace rung::text
