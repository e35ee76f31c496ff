// Rungs, names and messages of two versions (see difference.h).
#include "tools/difference/difference.h"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <map>
#include <set>
#include <unordered_map>

#include "tools/difference/alignment.h"
#include "tools/difference/meaning.h"

namespace rung::difference {
namespace {

using ir::Module;
using ir::Symbol;

using ByRoutine = std::map<std::string, std::vector<DrawnRung>>;

ByRoutine byRoutine(const std::vector<DrawnRung>& rungs) {
  ByRoutine routines;
  for (const DrawnRung& rung : rungs) routines[rung.routine->name].push_back(rung);
  return routines;
}

std::vector<uint64_t> meaningsOf(const std::vector<DrawnRung>& rungs) {
  std::vector<uint64_t> meanings;
  for (const DrawnRung& rung : rungs) meanings.push_back(rung.meaning);
  return meanings;
}

class RungComparison {
public:
  explicit RungComparison(Difference& out) : out_(out) {}

  void routine(const std::vector<DrawnRung>& before, const std::vector<DrawnRung>& after) {
    auto pairs = align(meaningsOf(before), meaningsOf(after));
    out_.same += pairs.size();
    pairs.emplace_back(before.size(), after.size());
    uint32_t b = 0;
    uint32_t a = 0;
    for (const auto& [nextBefore, nextAfter] : pairs) {
      between({before.begin() + b, before.begin() + nextBefore}, {after.begin() + a, after.begin() + nextAfter});
      b = nextBefore + 1;
      a = nextAfter + 1;
    }
  }

  // A rung that is gone here and new there has moved, or where only its title is the same it has changed, too.
  void findMoves() {
    std::set<size_t> gone;
    // Of each key, "" for none, the first that is gone is the first that is new.
    const auto join = [&](ChangeKind kind, auto key) {
      std::unordered_map<std::string, std::deque<size_t>> removed;
      for (size_t i = 0; i < changes_.size(); ++i)
        if (changes_[i].kind == ChangeKind::Removed && !gone.contains(i)) removed[key(i)].push_back(i);
      for (size_t i = 0; i < changes_.size(); ++i) {
        if (changes_[i].kind != ChangeKind::Added || key(i).empty()) continue;
        const auto from = removed.find(key(i));
        if (from == removed.end() || from->second.empty()) continue;
        changes_[i] = {kind, changes_[from->second.front()].before, changes_[i].after};
        gone.insert(from->second.front());
        from->second.pop_front();
      }
    };
    join(ChangeKind::Moved, [&](size_t i) { return std::to_string(meanings_[i]); });
    join(ChangeKind::Changed, [&](size_t i) {
      return changes_[i].before != nullptr ? changes_[i].before->title : changes_[i].after->title;
    });
    for (size_t i = 0; i < changes_.size(); ++i)
      if (!gone.contains(i)) out_.rungs.push_back(changes_[i]);
  }

private:
  using Rungs = std::vector<DrawnRung>;

  // No two of these are the same: those of one title are one rung that has changed; without titles, as many as there
  // are on both sides go together in their order.
  void between(Rungs before, const Rungs& after) {
    const bool asMany = before.size() == after.size();
    for (size_t i = 0; i < after.size(); ++i) {
      const std::string& title = after[i].rung->title;
      auto with = before.end();
      if (!title.empty())
        with = std::ranges::find_if(before, [&](const DrawnRung& r) { return r.rung && r.rung->title == title; });
      if (with == before.end() && asMany && before[i].rung != nullptr && before[i].rung->title.empty())
        with = before.begin() + static_cast<ptrdiff_t>(i);
      if (with == before.end()) {
        add({ChangeKind::Added, nullptr, after[i].rung}, after[i].meaning);
        continue;
      }
      add({ChangeKind::Changed, with->rung, after[i].rung}, 0);
      with->rung = nullptr;
    }
    for (const DrawnRung& rung : before)
      if (rung.rung != nullptr) add({ChangeKind::Removed, rung.rung, nullptr}, rung.meaning);
  }

  void add(const RungChange& change, uint64_t meaning) {
    changes_.push_back(change);
    meanings_.push_back(meaning);
  }

  Difference& out_;
  std::vector<RungChange> changes_;
  std::vector<uint64_t> meanings_; // of what is added or removed
};

// ---- names and messages --------------------------------------------------------------------------------------------

// Of names whose addresses the compiler gives out the type.
std::string meaningOf(const Module& module, const Symbol& symbol) {
  if (!symbol.space.valid()) return fmt::format("constant {}", symbol.value);
  const ir::Space& space = module.at(symbol.space);
  constexpr std::string_view kTypes[] = {"", "bit", "byte", "16 bits", "32 bits", "64 bits", "real"};
  const std::string type(symbol.type < std::size(kTypes) ? kTypes[symbol.type] : "");
  const std::string count = symbol.count > 1 ? fmt::format(" × {}", symbol.count) : "";
  if ((space.flags & RUNG_SPACE_ALLOCATED) != 0) return type + count;
  return fmt::format("{}{}{}", space.name, symbol.byte / space.unitBytes,
                     symbol.type == RUNG_TYPE_BIT ? fmt::format(".{}", symbol.byte % space.unitBytes * 8 + symbol.bit)
                                                  : " " + type) +
         count;
}

using Names = std::map<std::string, std::string>;
using Messages = std::map<uint32_t, std::string>;

Names namesOf(const Module& module) {
  Names names;
  for (const Symbol& symbol : module.symbols)
    if ((symbol.flags & RUNG_SYMBOL_HIDDEN) == 0) names.emplace(symbol.name, meaningOf(module, symbol));
  return names;
}

Messages messagesOf(const Module& module) {
  Messages messages;
  for (const ir::MessageText& message : module.messages) messages.emplace(message.number, message.text);
  return messages;
}

template <class Texts>
std::vector<NameChange> changesOf(const Texts& before, const Texts& after) {
  Texts all = before;
  all.insert(after.begin(), after.end());
  std::vector<NameChange> changes;
  for (const auto& [name, what] : all) {
    const auto old = before.find(name);
    const auto now = after.find(name);
    if (old == before.end())
      changes.push_back({ChangeKind::Added, fmt::format("{}", name), "", now->second});
    else if (now == after.end())
      changes.push_back({ChangeKind::Removed, fmt::format("{}", name), old->second, ""});
    else if (old->second != now->second)
      changes.push_back({ChangeKind::Changed, fmt::format("{}", name), old->second, now->second});
  }
  return changes;
}

} // namespace

std::string_view nameOf(ChangeKind kind) {
  constexpr std::string_view kNames[] = {"added", "removed", "changed", "moved"};
  return kNames[static_cast<int>(kind)];
}

Difference compare(const Module& before, const Module& after) {
  Difference difference;
  RungComparison rungs(difference);
  const std::vector<DrawnRung> drawn = drawnRungs(after);
  ByRoutine old = byRoutine(drawnRungs(before));
  const ByRoutine fresh = byRoutine(drawn);
  std::set<std::string> done;
  for (const DrawnRung& rung : drawn) { // routines in the order of the new program
    const std::string& name = rung.routine->name;
    if (done.insert(name).second) rungs.routine(old[name], fresh.at(name));
  }
  for (const auto& [name, gone] : old)
    if (!fresh.contains(name)) rungs.routine(gone, {});
  rungs.findMoves();
  difference.names = changesOf(namesOf(before), namesOf(after));
  difference.messages = changesOf(messagesOf(before), messagesOf(after));
  return difference;
}

} // namespace rung::difference
