// TOML within bounds: toml++ follows the parts of a key by recursion, and a key of a hundred thousand parts would end
// the process.
#pragma once
#include <algorithm>
#include <string_view>

#include <toml++/toml.h>

namespace rung::toml_text {

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

// Where a key has more parts; npos: nowhere.
inline size_t findLongKey(std::string_view text) {
  size_t parts = 1;
  for (size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = endOfString(text, at);
      continue;
    }
    if (c == '#') at = std::min(text.find('\n', at), text.size() - 1);
    if (std::string_view("=,{}[]\n#").find(c) != std::string_view::npos) parts = 1;
    if (c == '.' && ++parts > kMostParts) return at;
    ++at;
  }
  return std::string_view::npos;
}

// Throws toml::parse_error. `path` is for its places.
inline toml::table parse(std::string_view text, std::string_view path = {}) {
  const size_t at = findLongKey(text);
  if (at == std::string_view::npos) return toml::parse(text, path);
  toml::source_position place{1, 1};
  for (const char c : text.substr(0, at)) {
    ++place.column;
    if (c == '\n') place = {place.line + 1, 1};
  }
  static_assert(kMostParts == 64, "as the sentence says");
  throw toml::parse_error("a key has more than 64 parts", place);
}

} // namespace rung::toml_text
