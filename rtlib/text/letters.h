// Capitals of ASCII letters, whatever the locale; all other bytes stay as they are.
#pragma once
#include <string>
#include <string_view>

namespace rung::text {

constexpr char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

inline std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = upper(c);
  return result;
}

} // namespace rung::text
