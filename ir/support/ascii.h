// Kinds of characters of ASCII, whatever the locale, and blanks around a text. Capitals: rtlib/text/letters.h.
#pragma once
#include <string_view>

namespace rung {

constexpr bool isDigit(char c) { return c >= '0' && c <= '9'; }
constexpr bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// What a hexadecimal digit of either case counts; -1 for any other character.
constexpr int hexDigit(char c) {
  if (isDigit(c)) return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/// A line without blanks and tabs at its ends, and without the CR of a line end of DOS.
constexpr std::string_view trimmed(std::string_view line) {
  constexpr std::string_view kSpace = " \t\r";
  const size_t first = line.find_first_not_of(kSpace);
  return first == std::string_view::npos ? std::string_view()
                                         : line.substr(first, line.find_last_not_of(kSpace) + 1 - first);
}

} // namespace rung
