// Pairs the rungs of two versions (see difference_pairs.h).
#include "tools/report/difference_pairs.h"

#include <algorithm>
#include <fmt/format.h>
#include <unordered_map>

namespace rung::report {
namespace {

using ir::Module;

std::vector<uint32_t> homesOf(const Module& module, const std::vector<DrawnRung>& rungs) {
  std::vector<uint32_t> homes;
  for (const DrawnRung& rung : rungs) homes.push_back(static_cast<uint32_t>(rung.routine - module.routines.data()));
  return homes;
}

std::vector<runtime::RungMark> marksOf(const std::vector<DrawnRung>& rungs, auto routineName) {
  std::vector<runtime::RungMark> marks;
  for (uint32_t i = 0; i < rungs.size(); ++i) marks.push_back({routineName(i), rungs[i].meaning, rungs[i].rung->title});
  return marks;
}

using Counts = std::unordered_map<uint64_t, uint32_t>; // number of rungs by meaning

struct Body {
  Counts counts;
  uint32_t size = 0;
};

std::vector<Body> bodiesOf(size_t routines, const std::vector<uint32_t>& homes, const std::vector<DrawnRung>& rungs) {
  std::vector<Body> bodies(routines);
  for (size_t i = 0; i < rungs.size(); ++i) {
    ++bodies[homes[i]].counts[rungs[i].meaning];
    ++bodies[homes[i]].size;
  }
  return bodies;
}

uint32_t commonOf(const Body& a, const Body& b) {
  uint32_t common = 0;
  for (const auto& [meaning, count] : a.counts)
    if (const auto at = b.counts.find(meaning); at != b.counts.end()) common += std::min(count, at->second);
  return common;
}

std::string placeOf(const Module& module, const DrawnRung& drawn) {
  const ir::Rung& rung = *drawn.rung;
  const std::string title = rung.title.empty() ? "" : fmt::format(" \"{}\"", rung.title);
  return fmt::format("rung {}{}, {}:{}", rung.number, title, module.files[rung.begin.file.index], rung.begin.line);
}

std::string nameOf(const Module& module, const std::vector<DrawnRung>& rungs, const Exit& exit) {
  switch (exit.to) {
  case Exit::To::Rung: return placeOf(module, rungs[exit.index]);
  case Exit::To::End: return fmt::format("the end of {}", shownName(module.routines[exit.index]));
  case Exit::To::Routine: return std::string(shownName(module.routines[exit.index]));
  }
  return {};
}

} // namespace

PairedRungs::PairedRungs(const Version& before, const Version& after, const FormerNames& former)
    : before_(drawnRungs(before.module, before.given, ownNames(former))),
      after_(drawnRungs(after.module, after.given, former)), homeBefore_(homesOf(before.module, before_)),
      homeAfter_(homesOf(after.module, after_)) {
  pairRoutines(before, after);
  const auto nameBefore = [&](uint32_t rung) {
    return std::string_view(before.module.routines[homeBefore_[rung]].name);
  };
  const auto nameAfter = [&](uint32_t rung) {
    const uint32_t routine = routineBefore_[homeAfter_[rung]];
    return std::string_view(routine != RUNG_NONE ? before.module.routines[routine].name
                                                 : after.module.routines[homeAfter_[rung]].name);
  };
  pairOf_.assign(after_.size(), RUNG_NONE);
  for (const runtime::RungPair& pair : runtime::alignRungs(marksOf(before_, nameBefore), marksOf(after_, nameAfter))) {
    pairs_.push_back({pair.before, pair.after, pair.kind, {}});
    pairOf_[pair.after] = pair.before;
  }
  findKept();
  for (Pair& pair : pairs_)
    if (pair.kind != runtime::RungKind::Changed) pair.paths = pathsOf(before, after, pair);
}

// Pairs by name; the rest by the meaning of their rungs, the most similar first.
void PairedRungs::pairRoutines(const Version& before, const Version& after) {
  const std::vector<ir::Routine>&old = before.module.routines, &now = after.module.routines;
  routineBefore_.assign(now.size(), RUNG_NONE);
  std::vector<bool> taken(old.size(), false);
  for (uint32_t a = 0; a < now.size(); ++a) {
    const auto at = std::ranges::find(old, now[a].name, &ir::Routine::name);
    if (at == old.end()) continue;
    routineBefore_[a] = static_cast<uint32_t>(at - old.begin());
    taken[routineBefore_[a]] = true;
  }
  const std::vector<Body> bodiesBefore = bodiesOf(old.size(), homeBefore_, before_);
  const std::vector<Body> bodiesAfter = bodiesOf(now.size(), homeAfter_, after_);
  struct Candidate {
    uint32_t common, before, after;
  };
  std::vector<Candidate> candidates;
  for (uint32_t a = 0; a < now.size(); ++a)
    for (uint32_t b = 0; b < old.size(); ++b) {
      if (routineBefore_[a] != RUNG_NONE || taken[b]) continue;
      const uint32_t common = commonOf(bodiesBefore[b], bodiesAfter[a]);
      if (common != 0 && 2 * common >= std::max(bodiesBefore[b].size, bodiesAfter[a].size))
        candidates.push_back({common, b, a});
    }
  std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::common);
  for (const Candidate& candidate : candidates) {
    if (routineBefore_[candidate.after] != RUNG_NONE || taken[candidate.before]) continue;
    routineBefore_[candidate.after] = candidate.before;
    taken[candidate.before] = true;
  }
}

// Finds the rungs that both versions have in one routine and in the same order.
void PairedRungs::findKept() {
  std::vector<bool> isKept(after_.size(), false);
  uint32_t last = 0; // equal rungs determine the order, changed ones must fit in
  std::vector<uint32_t> open;
  const auto inHome = [&](uint32_t a) { return routineBefore_[homeAfter_[a]] == homeBefore_[pairOf_[a]]; };
  const auto close = [&](uint32_t end) {
    for (const uint32_t a : open)
      if (pairOf_[a] >= last && pairOf_[a] < end) {
        isKept[a] = true;
        last = pairOf_[a] + 1;
      }
    open.clear();
    last = end + 1;
  };
  uint32_t home = RUNG_NONE;
  for (const Pair& pair : pairs_) {
    if (pair.kind == runtime::RungKind::Moved || !inHome(pair.after)) continue;
    if (homeAfter_[pair.after] != home) {
      close(static_cast<uint32_t>(before_.size()));
      last = 0;
    }
    home = homeAfter_[pair.after];
    if (pair.kind == runtime::RungKind::Changed) {
      open.push_back(pair.after);
      continue;
    }
    close(pair.before);
    isKept[pair.after] = true;
  }
  close(static_cast<uint32_t>(before_.size()));
  std::vector<bool> isThere(before_.size(), false);
  for (uint32_t a = 0; a < after_.size(); ++a)
    if (isKept[a]) isThere[pairOf_[a]] = true;
  keptBefore_.assign(before_.size(), RUNG_NONE);
  for (uint32_t b = static_cast<uint32_t>(before_.size()); b-- > 0;)
    keptBefore_[b] = isThere[b]                                                       ? b
                     : b + 1 < before_.size() && homeBefore_[b + 1] == homeBefore_[b] ? keptBefore_[b + 1]
                                                                                      : RUNG_NONE;
  keptAfter_.assign(after_.size(), RUNG_NONE);
  for (uint32_t a = static_cast<uint32_t>(after_.size()); a-- > 0;)
    keptAfter_[a] = isKept[a]                                                     ? pairOf_[a]
                    : a + 1 < after_.size() && homeAfter_[a + 1] == homeAfter_[a] ? keptAfter_[a + 1]
                                                                                  : RUNG_NONE;
}

bool PairedRungs::leadsAlike(const Exit& before, const Exit& after) const {
  if (before.to == Exit::To::Routine || after.to == Exit::To::Routine)
    return before.to == after.to && routineBefore_[after.index] == before.index;
  const auto isRung = [](const Exit& exit) { return exit.to == Exit::To::Rung; };
  if (isRung(before) && isRung(after)) {
    if (pairOf_[after.index] == before.index) return before.part == after.part;
    if (before.part != 0 || after.part != 0) return false;
  }
  const uint32_t homeBefore = isRung(before) ? homeBefore_[before.index] : before.index;
  const uint32_t homeAfter = isRung(after) ? homeAfter_[after.index] : after.index;
  const uint32_t keptBefore = isRung(before) ? keptBefore_[before.index] : RUNG_NONE;
  const uint32_t keptAfter = isRung(after) ? keptAfter_[after.index] : RUNG_NONE;
  return routineBefore_[homeAfter] == homeBefore && keptBefore == keptAfter;
}

std::vector<ChangedPath> PairedRungs::pathsOf(const Version& before, const Version& after, const Pair& pair) const {
  const std::vector<Exit>&old = before_[pair.before].exits, &now = after_[pair.after].exits;
  std::vector<ChangedPath> paths;
  for (size_t i = 0; i < std::min(old.size(), now.size()); ++i) {
    if (leadsAlike(old[i], now[i])) continue;
    ChangedPath path{nameOf(before.module, before_, old[i]), nameOf(after.module, after_, now[i])};
    if (std::ranges::find(paths, path) == paths.end()) paths.push_back(std::move(path));
  }
  return paths;
}

} // namespace rung::report
