// Where a text file of DOS ends.
#pragma once
#include <string_view>

namespace rung::text {

// The text before the mark by which DOS ends a file; what follows the mark need not be text.
constexpr std::string_view upToEndOfFile(std::string_view text) {
  constexpr char kMark = 0x1A;
  return text.substr(0, text.find(kMark));
}

} // namespace rung::text
