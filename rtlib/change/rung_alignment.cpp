// Patience alignment, and matching of the rungs that it leaves.
#include "rtlib/change/rung_alignment.h"

#include <algorithm>
#include <charconv>
#include <deque>
#include <map>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "rung/runtime.h"
#include "rung/types.hpp"

namespace rung::runtime {

namespace {

using Pair = std::pair<uint32_t, uint32_t>;

// The longest subsequence of pairs, which ascend by their first parts, whose second parts ascend, too.
std::vector<Pair> longestAscending(const std::vector<Pair>& pairs) {
  constexpr size_t kNone = ~size_t{0};
  std::vector<size_t> tops; // by length: the pair with the least second part that ends such a subsequence
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

  // The items between two that occur once on each side form a section.
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

class RungAligner {
public:
  RungAligner(std::span<const RungMark> before, std::span<const RungMark> after)
      : before_(before), after_(after), taken_(before.size(), false), found_(after.size()) {}

  std::vector<RungPair> run() {
    const Routines former = routinesOf(before_);
    for (const auto& [name, rungs] : routinesOf(after_))
      if (const auto there = former.find(name); there != former.end()) routine(there->second, rungs);
    join(all(), RungKind::Moved, [](const RungMark& rung) { return std::to_string(rung.what); });
    for (const Gap& gap : gaps_) {
      join(gap, RungKind::Changed, [](const RungMark& rung) { return std::string(rung.title); });
      pairInOrder(gap);
    }
    join(all(), RungKind::Changed, [](const RungMark& rung) { return std::string(rung.title); });
    std::vector<RungPair> pairs;
    for (uint32_t a = 0; a < after_.size(); ++a)
      if (found_[a].before != kNone) pairs.push_back({found_[a].before, a, found_[a].kind});
    return pairs;
  }

private:
  static constexpr uint32_t kNone = ~0u;
  struct Found {
    uint32_t before = kNone;
    RungKind kind = RungKind::Same;
  };
  struct Rungs {
    uint32_t first = 0, end = 0;
  };
  struct Gap {
    Rungs before, after;
  };
  using Routines = std::map<std::string_view, Rungs>;

  Gap all() const { return {{0, static_cast<uint32_t>(before_.size())}, {0, static_cast<uint32_t>(after_.size())}}; }

  static Routines routinesOf(std::span<const RungMark> rungs) {
    Routines routines;
    for (uint32_t i = 0; i < rungs.size(); ++i) {
      const auto [at, isNew] = routines.try_emplace(rungs[i].routine, Rungs{i, i});
      at->second.end = i + 1;
    }
    return routines;
  }

  static std::vector<uint64_t> whatOf(std::span<const RungMark> rungs, const Rungs& some) {
    std::vector<uint64_t> what;
    for (uint32_t i = some.first; i < some.end; ++i) what.push_back(rungs[i].what);
    return what;
  }

  void pair(uint32_t before, uint32_t after, RungKind kind) {
    taken_[before] = true;
    found_[after] = {before, kind};
  }

  void routine(const Rungs& before, const Rungs& after) {
    uint32_t b = before.first;
    uint32_t a = after.first;
    for (const auto& [sameBefore, sameAfter] : align(whatOf(before_, before), whatOf(after_, after))) {
      gaps_.push_back({{b, before.first + sameBefore}, {a, after.first + sameAfter}});
      pair(before.first + sameBefore, after.first + sameAfter, RungKind::Same);
      b = before.first + sameBefore + 1;
      a = after.first + sameAfter + 1;
    }
    gaps_.push_back({{b, before.end}, {a, after.end}});
  }

  // Pairs removed and new rungs with equal keys in order; "" is not a key.
  template <class Key>
  void join(const Gap& gap, RungKind kind, Key key) {
    std::unordered_map<std::string, std::deque<uint32_t>> gone;
    for (uint32_t b = gap.before.first; b < gap.before.end; ++b)
      if (!taken_[b]) gone[key(before_[b])].push_back(b);
    if (gone.empty()) return;
    for (uint32_t a = gap.after.first; a < gap.after.end; ++a) {
      if (found_[a].before != kNone) continue;
      const std::string wanted = key(after_[a]);
      const auto from = gone.find(wanted);
      if (wanted.empty() || from == gone.end() || from->second.empty()) continue;
      pair(from->second.front(), a, kind);
      from->second.pop_front();
    }
  }

  // Pairs the rungs without titles in order, if there are equally many on both sides.
  void pairInOrder(const Gap& gap) {
    std::vector<uint32_t> gone, added;
    for (uint32_t b = gap.before.first; b < gap.before.end; ++b)
      if (!taken_[b] && before_[b].title.empty()) gone.push_back(b);
    for (uint32_t a = gap.after.first; a < gap.after.end; ++a)
      if (found_[a].before == kNone && after_[a].title.empty()) added.push_back(a);
    for (size_t i = 0; gone.size() == added.size() && i < gone.size(); ++i) pair(gone[i], added[i], RungKind::Changed);
  }

  std::span<const RungMark> before_;
  std::span<const RungMark> after_;
  std::vector<bool> taken_;  // by rung before
  std::vector<Found> found_; // by rung after
  std::vector<Gap> gaps_;    // between pairs of the same rungs
};

} // namespace

std::vector<Pair> align(std::span<const uint64_t> before, std::span<const uint64_t> after) {
  return Aligner(before, after).run();
}

std::vector<RungPair> alignRungs(std::span<const RungMark> before, std::span<const RungMark> after) {
  return RungAligner(before, after).run();
}

std::vector<RungMark> rungMarks(const rung_program& program) {
  std::vector<RungMark> marks;
  for (uint32_t i = 0; i < program.rung_count; ++i) {
    const rung_info& rung = program.rungs[i];
    marks.push_back({program.routines[rung.routine], textOfKey(rung.key, rung.copy), rung.title, rung.number});
  }
  return marks;
}

namespace {

bool isFirstPiece(std::span<const RungMark> marks, uint32_t rung) {
  const uint32_t number = marks[rung].number;
  return number != 0 && (rung == 0 || marks[rung - 1].number != number);
}

} // namespace

uint32_t changeKind(const RungChange& change) {
  if (change.after == RUNG_NONE) return RUNG_RUNG_REMOVED;
  if (change.before == RUNG_NONE) return RUNG_RUNG_NEW;
  return change.kind == RungKind::Moved ? RUNG_RUNG_MOVED : RUNG_RUNG_CHANGED;
}

std::vector<RungChange> changedRungs(std::span<const RungMark> before, std::span<const RungMark> after,
                                     std::span<const RungPair> pairs) {
  std::vector<RungChange> changes;
  std::vector<bool> isThere(before.size(), false);
  for (const RungPair& pair : pairs) isThere[pair.before] = true;
  auto pair = pairs.begin();
  for (uint32_t a = 0; a < after.size(); ++a) {
    const bool known = pair != pairs.end() && pair->after == a;
    if (isFirstPiece(after, a) && (!known || pair->kind != RungKind::Same))
      changes.push_back({known ? pair->kind : RungKind::Changed, known ? pair->before : RUNG_NONE, a});
    if (known) ++pair;
  }
  for (uint32_t b = 0; b < before.size(); ++b)
    if (!isThere[b] && isFirstPiece(before, b)) changes.push_back({.before = b});
  return changes;
}

// Matches state by rungs, and then by keys.

namespace {

constexpr char kNumber = '~'; // before the number of an instruction, see rung_slot

// The key without its numbers, and the numbers, which give the order of equal instructions.
using Alike = std::pair<std::string, std::vector<uint32_t>>;

Alike alike(std::string_view key) {
  Alike out;
  while (!key.empty()) {
    const size_t at = std::min(key.find(kNumber), key.size());
    out.first += key.substr(0, at);
    key.remove_prefix(std::min(at + 1, key.size()));
    uint32_t number = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), number);
    key.remove_prefix(static_cast<size_t>(end - key.data()));
    if (error == std::errc()) out.second.push_back(number);
  }
  return out;
}

// The states of a rung with the same key, in the order of their instructions.
using Groups = std::map<std::pair<uint32_t, std::string>, std::vector<std::pair<std::vector<uint32_t>, uint32_t>>>;

Groups grouped(std::span<const InstructionState> all, const std::vector<bool>& done, bool byRung) {
  Groups groups;
  for (uint32_t i = 0; i < all.size(); ++i) {
    if (done[i] || (byRung && all[i].rung == RUNG_NONE)) continue;
    auto [key, numbers] = alike(all[i].key);
    groups[{byRung ? all[i].rung : 0, std::move(key)}].emplace_back(std::move(numbers), i);
  }
  for (auto& [key, members] : groups) std::ranges::sort(members);
  return groups;
}

class Matcher {
public:
  Matcher(std::span<const InstructionState> before, std::span<const InstructionState> after)
      : before_(before), after_(after), isGone_(before.size(), false), isFound_(after.size(), false),
        found_(after.size(), RUNG_NONE) {}

  std::vector<uint32_t> run(std::span<const RungPair> rungs) {
    const Groups former = grouped(before_, isGone_, true);
    const Groups now = grouped(after_, isFound_, true);
    std::unordered_map<uint32_t, uint32_t> formerRung;
    for (const RungPair& pair : rungs) formerRung.emplace(pair.after, pair.before);
    for (const auto& [of, members] : now) {
      const auto rung = formerRung.find(of.first);
      if (rung == formerRung.end()) continue;
      if (const auto there = former.find({rung->second, of.second}); there != former.end())
        pair(there->second, members);
    }
    const Groups left = grouped(before_, isGone_, false);
    for (const auto& [of, members] : grouped(after_, isFound_, false))
      if (const auto there = left.find(of); there != left.end() && there->second.size() == members.size())
        pair(there->second, members);
    return std::move(found_);
  }

private:
  using Members = Groups::mapped_type;

  void pair(const Members& before, const Members& after) {
    for (size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
      isGone_[before[i].second] = isFound_[after[i].second] = true;
      found_[after[i].second] = before[i].second;
    }
  }

  std::span<const InstructionState> before_, after_;
  std::vector<bool> isGone_, isFound_;
  std::vector<uint32_t> found_;
};

} // namespace

std::vector<uint32_t> matchState(std::span<const InstructionState> before, std::span<const InstructionState> after,
                                 std::span<const RungPair> rungs) {
  return Matcher(before, after).run(rungs);
}

std::string withoutNumbers(std::string_view key) { return alike(key).first; }

} // namespace rung::runtime
