// "Did you mean …": the known word that is most like a misspelt one.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace rung::text {

/// Takes candidates one by one. A candidate is close when it differs by one change in words of up to four characters
/// and by two in longer ones; a change is an inserted, deleted or substituted character, or two adjacent characters
/// exchanged. Case is ignored. Of equally close candidates the first wins.
class Similar {
public:
  explicit Similar(std::string_view word);
  void offer(std::string_view candidate);
  /// Empty if no candidate is close.
  std::string_view best() const { return best_; }
  /// Whether the word can only be a typing error for the best candidate: different case, two adjacent letters
  /// exchanged, a letter doubled or a double letter halved, a `_` inserted or missing, and no other candidate as close.
  /// ANDD is AND, but VALVE_B may be another valve than VALVE_A, and a tool that replaces it changes what a machine
  /// does.
  bool certain() const;
  /// Whether several candidates are one change away: RSET may be SET or RST.
  bool ambiguous() const { return hasRival_ && bound_ == 1; }

private:
  size_t distance(std::string_view candidate) const;

  std::string word_; // in upper case
  size_t bound_;     // candidates must be closer
  std::string_view best_;
  bool hasRival_ = false; // another candidate is as close as the best one
};

/// The closest candidate, empty if none is close; and whether it is certainly meant (Similar::certain).
struct Likely {
  std::string_view word;
  bool certain = false;
};

/// The most similar name of the candidates, which outlive the result.
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
