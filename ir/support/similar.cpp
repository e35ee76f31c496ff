// Edit distance of short words.
#include "ir/support/similar.h"

#include <algorithm>
#include <array>

#include "rtlib/text/letters.h"

namespace rung {
namespace {

constexpr size_t kShortWord = 4;
constexpr size_t kLongest = 32; // nobody misspells longer ones by two characters and looks for help

} // namespace

Similar::Similar(std::string_view word) : word_(text::upper(word)), bound_(word.size() <= kShortWord ? 2 : 3) {}

// Damerau's distance with three rows of the table.
size_t Similar::distance(std::string_view candidate) const {
  using Row = std::array<size_t, kLongest + 1>;
  std::array<Row, 3> rows{};
  for (size_t j = 0; j <= candidate.size(); ++j) rows[0][j] = j;
  for (size_t i = 1; i <= word_.size(); ++i) {
    Row& row = rows[i % 3];
    const Row& above = rows[(i - 1) % 3];
    row[0] = i;
    for (size_t j = 1; j <= candidate.size(); ++j) {
      const char a = word_[i - 1], b = text::upper(candidate[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a == b ? 0u : 1u)});
      const bool exchanged = i > 1 && j > 1 && a == text::upper(candidate[j - 2]) && word_[i - 2] == b;
      if (exchanged) row[j] = std::min(row[j], rows[(i + 1) % 3][j - 2] + 1);
    }
  }
  return rows[word_.size() % 3][candidate.size()];
}

void Similar::offer(std::string_view candidate) {
  if (word_.size() > kLongest || candidate.size() > kLongest) return;
  const size_t shorter = std::min(word_.size(), candidate.size());
  if (std::max(word_.size(), candidate.size()) - shorter >= bound_) return;
  const size_t d = distance(candidate);
  if (d >= bound_ || d >= shorter) return; // nothing in common is not alike
  bound_ = d;
  best_ = candidate;
}

std::string didYouMean(std::string_view word) {
  return word.empty() ? "" : "; did you mean " + std::string(word) + "?";
}

} // namespace rung
