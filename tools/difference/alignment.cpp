// Patience alignment (see alignment.h).
#include "tools/difference/alignment.h"

#include <algorithm>
#include <unordered_map>

namespace rung::difference {
namespace {

using Pair = std::pair<uint32_t, uint32_t>;

// Of pairs with ascending first parts the longest run whose second parts ascend, too.
std::vector<Pair> longestAscending(const std::vector<Pair>& pairs) {
  constexpr size_t kNone = ~size_t{0};
  std::vector<size_t> tops; // of each length the pair with the least second part that ends such a run
  std::vector<size_t> before(pairs.size(), kNone);
  for (size_t i = 0; i < pairs.size(); ++i) {
    const auto at = std::ranges::lower_bound(tops, pairs[i].second, {}, [&](size_t top) { return pairs[top].second; });
    if (at != tops.begin()) before[i] = *std::prev(at);
    if (at == tops.end())
      tops.push_back(i);
    else
      *at = i;
  }
  std::vector<Pair> run;
  for (size_t i = tops.empty() ? kNone : tops.back(); i != kNone; i = before[i]) run.push_back(pairs[i]);
  std::ranges::reverse(run);
  return run;
}

struct Section {
  uint32_t before, beforeEnd, after, afterEnd;
};

class Aligner {
public:
  Aligner(std::span<const uint64_t> before, std::span<const uint64_t> after) : before_(before), after_(after) {}

  std::vector<Pair> run() {
    open_.push_back({0, static_cast<uint32_t>(before_.size()), 0, static_cast<uint32_t>(after_.size())});
    while (!open_.empty()) {
      Section section = open_.back();
      open_.pop_back();
      pairEnds(section);
      divide(section);
    }
    std::ranges::sort(pairs_);
    return std::move(pairs_);
  }

private:
  void pairEnds(Section& s) {
    while (s.before < s.beforeEnd && s.after < s.afterEnd && before_[s.before] == after_[s.after])
      pairs_.emplace_back(s.before++, s.after++);
    while (s.before < s.beforeEnd && s.after < s.afterEnd && before_[s.beforeEnd - 1] == after_[s.afterEnd - 1])
      pairs_.emplace_back(--s.beforeEnd, --s.afterEnd);
  }

  // What lies between items that are once on each side is a section of its own.
  void divide(const Section& s) {
    struct Seen {
      uint32_t before = 0, after = 0, timesBefore = 0, timesAfter = 0;
    };
    std::unordered_map<uint64_t, Seen> seen;
    for (uint32_t i = s.before; i < s.beforeEnd; ++i) {
      Seen& item = seen[before_[i]];
      item.before = i;
      ++item.timesBefore;
    }
    for (uint32_t i = s.after; i < s.afterEnd; ++i) {
      Seen& item = seen[after_[i]];
      item.after = i;
      ++item.timesAfter;
    }
    std::vector<Pair> once;
    for (const auto& [value, item] : seen)
      if (item.timesBefore == 1 && item.timesAfter == 1) once.emplace_back(item.before, item.after);
    std::ranges::sort(once);
    Section rest = s;
    const std::vector<Pair> kept = longestAscending(once);
    for (const auto& [before, after] : kept) {
      open_.push_back({rest.before, before, rest.after, after});
      pairs_.emplace_back(before, after);
      rest.before = before + 1;
      rest.after = after + 1;
    }
    if (!kept.empty()) open_.push_back(rest);
  }

  std::span<const uint64_t> before_;
  std::span<const uint64_t> after_;
  std::vector<Section> open_;
  std::vector<Pair> pairs_;
};

} // namespace

std::vector<Pair> align(std::span<const uint64_t> before, std::span<const uint64_t> after) {
  return Aligner(before, after).run();
}

} // namespace rung::difference
