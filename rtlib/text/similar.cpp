// Edit distance of short words.
#include "rtlib/text/similar.h"

#include <algorithm>
#include <array>
#include <utility>

#include "rtlib/text/letters.h"

namespace rung::text {
namespace {

constexpr size_t kShortWord = 4;
constexpr size_t kLongest = 32; // longer names are rarely misspelt by two characters

/// The number of letters around `at` without a `_` or digit between. Short groups distinguish names: LS_A and LS_AA,
/// LS_AB and LS_BA.
size_t lettersAround(std::string_view word, size_t at) {
  size_t begin = at, end = at;
  while (begin > 0 && isLetter(word[begin - 1])) --begin;
  while (end < word.size() && isLetter(word[end])) ++end;
  return end - begin;
}

/// Whether the character at `at` of the longer word is a surplus `_` or repeats the letter beside it.
bool isSurplus(std::string_view longer, size_t at) {
  const char before = at > 0 ? longer[at - 1] : '_';
  const char after = at + 1 < longer.size() ? longer[at + 1] : '_';
  if (longer[at] == '_') return isLetter(before) || isLetter(after); // but not in K1_1 and K11
  return isLetter(longer[at]) && (before == longer[at] || after == longer[at]) && lettersAround(longer, at) > 2;
}

bool isExchange(std::string_view a, std::string_view b, size_t at) {
  return at + 1 < a.size() && isLetter(a[at]) && isLetter(b[at]) && a[at] == b[at + 1] && a[at + 1] == b[at] &&
         a.substr(at + 2) == b.substr(at + 2) && lettersAround(a, at) > 2;
}

/// Whether the words differ by a typing error; both are in upper case.
bool isSlip(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) std::swap(a, b);
  const auto at = static_cast<size_t>(std::mismatch(a.begin(), a.end(), b.begin()).first - a.begin());
  if (at == b.size()) return true;
  if (b.size() == a.size() + 1) return a.substr(at) == b.substr(at + 1) && isSurplus(b, at);
  return a.size() == b.size() && isExchange(a, b, at);
}

} // namespace

Similar::Similar(std::string_view word) : word_(upper(word)), bound_(word.size() <= kShortWord ? 2 : 3) {}

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
      const char a = word_[i - 1], b = upper(candidate[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a == b ? 0u : 1u)});
      const bool exchanged = i > 1 && j > 1 && a == upper(candidate[j - 2]) && word_[i - 2] == b;
      if (exchanged) row[j] = std::min(row[j], rows[(i + 1) % 3][j - 2] + 1);
    }
  }
  return rows[word_.size() % 3][candidate.size()];
}

void Similar::offer(std::string_view candidate) {
  if (word_.size() > kLongest || candidate.size() > kLongest) return;
  const size_t shorter = std::min(word_.size(), candidate.size());
  const size_t most = best_.empty() ? bound_ - 1 : bound_;
  if (std::max(word_.size(), candidate.size()) - shorter > most) return;
  const size_t d = distance(candidate);
  if (d > most || d >= shorter) return; // words with nothing in common are not similar
  if (!best_.empty() && d == bound_) {
    hasRival_ = hasRival_ || candidate != best_;
    return;
  }
  bound_ = d;
  best_ = candidate;
  hasRival_ = false;
}

bool Similar::certain() const { return !best_.empty() && !hasRival_ && isSlip(word_, upper(best_)); }

std::string didYouMean(std::string_view word) {
  return word.empty() ? "" : "; did you mean " + std::string(word) + "?";
}

} // namespace rung::text
