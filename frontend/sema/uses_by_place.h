// What is written at the places of a text, looked up by binary search.
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "ir/support/source.h"

namespace rung::frontend {

// A Use has a `range`. Ranges may hold others: that of an operand the index in it.
template <class Use>
class UsesByPlace {
public:
  void add(const Use& use) { uses_.push_back(use); }
  // Once, when all are there: puts them in the order of the sources. Of several with one range `once` keeps the first.
  void settle(bool once) {
    std::ranges::stable_sort(uses_, {}, beginOf);
    if (once) {
      const auto again = std::ranges::unique(uses_, {}, &Use::range);
      uses_.erase(again.begin(), again.end());
    }
    SourcePos end;
    for (const Use& use : uses_) ends_.push_back(end = std::max(end, use.range.end));
  }

  // Afterwards.
  std::span<const Use> all() const { return uses_; }
  // The one with exactly this range; null when there is none.
  const Use* at(SourceRange range) const {
    const auto found = std::ranges::lower_bound(uses_, range.begin, {}, beginOf);
    return found != uses_.end() && found->range == range ? &*found : nullptr;
  }
  // The shortest that holds the position; null when none does.
  const Use* at(SourcePos position) const {
    const Use* best = nullptr;
    size_t i = static_cast<size_t>(std::ranges::upper_bound(uses_, position, {}, beginOf) - uses_.begin());
    for (; i > 0 && position < ends_[i - 1]; --i) {
      const Use& use = uses_[i - 1];
      if (position < use.range.end && (best == nullptr || lengthOf(use) <= lengthOf(*best))) best = &use;
    }
    return best;
  }

private:
  static SourcePos beginOf(const Use& use) { return use.range.begin; }
  static uint32_t lengthOf(const Use& use) { return use.range.end.value - use.range.begin.value; }

  std::vector<Use> uses_;
  std::vector<SourcePos>
      ends_; // the last end of this and all before it: nothing further left holds a position after it
};

} // namespace rung::frontend
