// What a message is about. Its sentence is in the golden of its module alone, so that a better one is one change;
// other tests look for the place, the code and the words that come from the input.
#pragma once
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace rung::test {

// "" where `text` has `words`, each after the one before it; else the first that it lacks.
inline std::string lacking(std::string_view text, std::initializer_list<std::string_view> words) {
  size_t from = 0;
  for (const std::string_view word : words) {
    const size_t found = text.find(word, from);
    if (found == std::string_view::npos) return "no '" + std::string(word) + "' in: " + std::string(text);
    from = found + word.size();
  }
  return "";
}

// A line each.
inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

} // namespace rung::test
