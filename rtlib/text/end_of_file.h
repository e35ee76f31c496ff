// The end of DOS text files.
#pragma once
#include <string_view>

namespace rung::text {

// The text before the DOS end-of-file mark; bytes after it need not be text.
constexpr std::string_view upToEndOfFile(std::string_view text) {
  constexpr char kMark = 0x1A;
  return text.substr(0, text.find(kMark));
}

} // namespace rung::text
