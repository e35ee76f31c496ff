// "Did you mean …": the known word that is most like a misspelt one.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace rung::text {

/// Takes candidates one by one. A candidate is close when it differs by one change in words of up to four characters
/// and by two in longer ones; a change is a character more, less, or other, or two neighbours exchanged. Other case of
/// letters counts as no change. The first of equally close candidates stays.
class Similar {
public:
  explicit Similar(std::string_view word);
  void offer(std::string_view candidate);
  /// Empty when nothing is close.
  std::string_view best() const { return best_; }
  /// Whether the word can be nothing but a slip of the hand for the best candidate: other case, two neighbouring
  /// letters exchanged, a letter doubled or halved, a `_` more or less, and no other candidate is as close. ANDD is
  /// AND, but VALVE_B may be a valve of its own beside VALVE_A, and a tool that puts the latter there changes what a
  /// machine does.
  bool certain() const;
  /// Whether one change makes the word any of several candidates: RSET may be SET or RST.
  bool ambiguous() const { return hasRival_ && bound_ == 1; }

private:
  size_t distance(std::string_view candidate) const;

  std::string word_; // in upper case
  size_t bound_;     // candidates must be closer
  std::string_view best_;
  bool hasRival_ = false; // as close as the best one
};

/// The closest candidate, empty when none is close; and whether it is certain that it was meant.
struct Likely {
  std::string_view word;
  bool certain = false;
};

/// Of the names of the candidates, which live longer than the result.
template <class Candidates, class NameOf = std::identity>
Likely likeliest(std::string_view word, Candidates&& candidates, NameOf nameOf = {}) {
  Similar similar(word);
  for (const auto& candidate : candidates) similar.offer(std::invoke(nameOf, candidate));
  return {similar.best(), similar.certain()};
}

template <class Candidates, class NameOf = std::identity>
std::string_view mostSimilar(std::string_view word, Candidates&& candidates, NameOf nameOf = {}) {
  return likeliest(word, std::forward<Candidates>(candidates), nameOf).word;
}

/// "; did you mean WORD?" for the end of a message; nothing for an empty word.
std::string didYouMean(std::string_view word);

} // namespace rung::text
