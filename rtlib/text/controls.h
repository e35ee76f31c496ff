// Control characters of ASCII, and those of Latin-1 in UTF-8: quoted text must not affect a terminal or begin lines in
// a log.
#pragma once
#include <string>
#include <string_view>

namespace rung::text {

constexpr bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

// U+0080 to U+009F.
constexpr bool isLatinControl(std::string_view text, size_t at) {
  return at + 1 < text.size() && text[at] == '\xC2' && static_cast<unsigned char>(text[at + 1]) >= 0x80 &&
         static_cast<unsigned char>(text[at + 1]) < 0xA0;
}

constexpr bool hasControls(std::string_view text) {
  for (size_t i = 0; i < text.size(); ++i)
    if (isControl(text[i]) || isLatinControl(text, i)) return true;
  return false;
}

// Replaces control characters by escapes ("\x1b" for ESC), except the characters in `kept`, such as "\n".
inline std::string withoutControls(std::string_view text, std::string_view kept = "") {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string result;
  const auto escape = [&](char c) {
    const auto byte = static_cast<unsigned char>(c);
    result.append("\\x") += {kDigits[byte >> 4], kDigits[byte & 15]};
  };
  for (size_t i = 0; i < text.size(); ++i)
    if (isLatinControl(text, i)) {
      escape(text[i]);
      escape(text[++i]);
    } else if (isControl(text[i]) && kept.find(text[i]) == std::string_view::npos) {
      escape(text[i]);
    } else {
      result += text[i];
    }
  return result;
}

} // namespace rung::text
