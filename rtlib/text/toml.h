// TOML within bounds: toml++ follows the parts of a key by recursion, and a key of a hundred thousand parts would end
// the process. Numbers of another base are 0x20 here, and 16#20 as in scenarios is refused.
#pragma once
#include <algorithm>
#include <string_view>

#include <toml++/toml.h>

#include "rtlib/text/end_of_file.h"

namespace rung::text {

inline constexpr size_t kMostParts = 64; // of a key

// Past the string that begins there.
inline size_t endOfString(std::string_view text, size_t at) {
  const std::string_view quote = text.substr(at, 1), longQuote = text.substr(at, 3);
  const bool isLong = longQuote.size() == 3 && longQuote[1] == quote[0] && longQuote[2] == quote[0];
  const std::string_view end = isLong ? longQuote : quote;
  for (at += end.size(); at < text.size() && text.substr(at, end.size()) != end; ++at) {
    if (!isLong && text[at] == '\n') return at; // it has no end, which the parser says
    if (quote == "\"" && text[at] == '\\') ++at;
  }
  return at + end.size();
}

// What the parser must not get, or would not refuse; null text: nothing.
struct Wrong {
  size_t at = 0;
  const char* text = nullptr;
};

// 16#20 is 16 and a comment for it.
inline Wrong findWrong(std::string_view text) {
  static_assert(kMostParts == 64, "as the sentence says");
  size_t parts = 1;
  for (size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = endOfString(text, at);
      continue;
    }
    const bool afterDigit = at > 0 && text[at - 1] >= '0' && text[at - 1] <= '9';
    if (c == '#' && afterDigit) return {at, "# begins a comment: write 0x20 for 16#20, or a blank before the comment"};
    if (c == '#') at = std::min(text.find('\n', at), text.size() - 1);
    if (std::string_view("=,{}[]\n#").find(c) != std::string_view::npos) parts = 1;
    if (c == '.' && ++parts > kMostParts) return {at, "a key has more than 64 parts"};
    ++at;
  }
  return {};
}

// Throws toml::parse_error. `path` is for its places.
inline toml::table parse(std::string_view text, std::string_view path = {}) {
  text = upToEndOfFile(text);
  const Wrong wrong = findWrong(text);
  if (wrong.text == nullptr) return toml::parse(text, path);
  toml::source_position place{1, 1};
  for (const char c : text.substr(0, wrong.at)) {
    ++place.column;
    if (c == '\n') place = {place.line + 1, 1};
  }
  throw toml::parse_error(wrong.text, place);
}

} // namespace rung::text
