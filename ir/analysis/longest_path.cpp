// Finds the longest path through the graph of rungs (see longest_path.h), without recursion: a routine may have 50,000
// rungs.
#include "ir/analysis/longest_path.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <utility>

#include "ir/analysis/rung_costs.h"
#include "ir/support/saturate.h"

namespace rung::ir {
namespace {

struct Place {
  RoutineId routine;
  uint32_t rung = 0; // index in the routine
};

// Longest paths from any rung to the end of its run, its routine, or a part of its task.
class Paths {
public:
  // `callees`: the paths through called routines; null: this object's. Paths end before the chunk `limit` and all later
  // ones.
  Paths(const Partition& partition, std::span<const uint64_t> costs, Paths* callees, uint32_t limit)
      : partition_(partition), costs_(costs), callees_(callees), limit_(limit),
        marks_(partition.rungCount(), Mark::New), longest_(partition.rungCount(), 0),
        next_(partition.rungCount(), RUNG_NONE), order_(partition.rungCount(), 0), lowest_(partition.rungCount(), 0),
        leadsToLoop_(partition.rungCount(), 0) {}

  uint64_t from(Place start) {
    stack_.push_back(start);
    while (!stack_.empty()) {
      const Place place = stack_.back();
      Mark& mark = marks_[number(place)];
      if (mark == Mark::New) {
        mark = Mark::Open;
        open(place);
        continue;
      }
      if (mark == Mark::Open) {
        longest_[number(place)] = measure(place);
        mark = Mark::Done;
        closeLoop(place);
      }
      stack_.pop_back();
    }
    return longest_[number(start)];
  }

  // The longest path from there within its routine.
  RoutinePath pathFrom(Place place) {
    RoutinePath path{.routine = place.routine, .cost = from(place), .rungs = {}, .calls = {}};
    for (; place.rung != RUNG_NONE; place.rung = next_[number(place)]) {
      const Transfer& transfer = transferOf(place);
      path.rungs.push_back(number(place));
      if (transfer.kind == TransferKind::Call) path.calls.push_back({number(place), transfer.callee});
    }
    return path;
  }

  // Rungs by number.
  const std::vector<std::vector<uint32_t>>& loops() const { return loops_; }
  // Whether some path from there, which has been measured, reaches a loop.
  bool leadsToLoop(Place place) const { return leadsToLoop_[number(place)] != 0; }

private:
  enum class Mark : uint8_t { New, Open, Done };
  static constexpr uint32_t kClosed = UINT32_MAX; // in `order_`: finished, its loop (if any) is known

  uint32_t number(Place place) const { return partition_.rungNumber(place.routine, place.rung); }
  const std::vector<Rung>& rungsOf(RoutineId routine) const { return partition_.module().at(routine).rungs; }
  const Transfer& transferOf(Place place) const { return rungsOf(place.routine)[place.rung].transfer; }

  // The paths from here must be known before the rung is finished.
  void open(Place place) {
    order_[number(place)] = lowest_[number(place)] = opened_++;
    reached_.push_back(number(place));
    const auto need = [&](Place next) {
      if (marks_[number(next)] == Mark::New) stack_.push_back(next);
    };
    const Transfer& transfer = transferOf(place);
    if (transfer.kind == TransferKind::Call && callees_ == nullptr) need({.routine = transfer.callee});
    forNext(place, transfer, need);
  }

  // A path that leads back to an open rung closes a loop, and ends there.
  uint64_t measure(Place place) {
    const Transfer& transfer = transferOf(place);
    uint32_t& best = next_[number(place)];
    uint64_t most = 0;
    forNext(place, transfer, [&](Place next) {
      if (marks_[number(next)] == Mark::Open || (best != RUNG_NONE && longest_[number(next)] <= most)) return;
      best = next.rung;
      most = longest_[number(next)];
    });
    if (transfer.kind == TransferKind::Call) {
      const Place callee{.routine = transfer.callee};
      most = saturatedSum(most, callees_ != nullptr ? callees_->from(callee) : longest_[number(callee)]);
    }
    return saturatedSum(most, costs_[number(place)]);
  }

  // Finds strongly connected components by Tarjan's algorithm; those with an edge back to their own rungs are loops.
  void closeLoop(Place place) {
    const uint32_t own = number(place);
    const Transfer& transfer = transferOf(place);
    bool itself = false;
    bool leads =
        transfer.kind == TransferKind::Call && callees_ == nullptr && leadsToLoop({.routine = transfer.callee});
    forNext(place, transfer, [&](Place next) {
      itself = itself || number(next) == own;
      leads = leads || leadsToLoop(next);
      if (order_[number(next)] != kClosed) lowest_[own] = std::min(lowest_[own], lowest_[number(next)]);
    });
    if (lowest_[own] != order_[own]) return;
    if (reached_.back() == own && !itself) { // a single rung
      reached_.pop_back();
      order_[own] = kClosed;
      leadsToLoop_[own] = leads ? 1 : 0;
      return;
    }
    const auto first = std::find(reached_.rbegin(), reached_.rend(), own).base() - 1;
    std::vector<uint32_t> rungs(first, reached_.end());
    reached_.erase(first, reached_.end());
    for (const uint32_t rung : rungs) {
      order_[rung] = kClosed;
      leadsToLoop_[rung] = 1;
    }
    std::ranges::sort(rungs);
    loops_.push_back(std::move(rungs));
  }

  // The rungs of the routine that control may reach next; for a call, after its return.
  template <class Visit>
  void forNext(Place place, const Transfer& transfer, Visit visit) const {
    const auto go = [&](uint32_t rung) {
      if (rung >= rungsOf(place.routine).size()) return;
      const Destination to = partition_.destination(place.routine, place.rung, rung);
      if (to.inside() || to.chunk < limit_) visit(Place{.routine = place.routine, .rung = rung});
    };
    const bool continues =
        transfer.kind == TransferKind::Next || transfer.kind == TransferKind::Call || transfer.cond.valid();
    if (continues) go(place.rung + 1);
    if (transfer.kind == TransferKind::Goto) go(transfer.target);
    for (const uint32_t target : transfer.targets) go(target);
  }

  const Partition& partition_;
  std::span<const uint64_t> costs_;
  Paths* callees_;
  uint32_t limit_;
  // By rung number.
  std::vector<Mark> marks_;
  std::vector<uint64_t> longest_;
  std::vector<uint32_t> next_;   // next rung on the longest path, in the same routine; RUNG_NONE: it ends
  std::vector<uint32_t> order_;  // order in which rungs were opened
  std::vector<uint32_t> lowest_; // lowest order that can be reached and is not in a loop found already
  std::vector<uint8_t> leadsToLoop_;
  uint32_t opened_ = 0;
  std::vector<uint32_t> reached_; // rungs whose loops are not known yet, in opening order
  std::vector<std::vector<uint32_t>> loops_;
  std::vector<Place> stack_;
};

// Finds the longest part of a task, or the path through the whole.
class TaskPaths {
public:
  TaskPaths(const Partition& partition, TaskId id, std::span<const uint64_t> costs)
      : partition_(partition), task_(partition.module().tasks[id.index]), whole_(partition, costs, nullptr, RUNG_NONE) {
    start_ = {.routine = task_.entry};
    if (task_.parts <= 1)
      cost_ = whole_.from(start_);
    else
      searchParts(partition.partEnds(id), costs);
    loops_.insert(loops_.end(), whole_.loops().begin(), whole_.loops().end());
    std::ranges::sort(loops_); // parts may share a loop
    const auto same = std::ranges::unique(loops_);
    loops_.erase(same.begin(), same.end());
  }

  uint64_t cost() const { return cost_; }
  uint32_t part() const { return part_; }
  const std::vector<std::vector<uint32_t>>& loops() const { return loops_; }

  // Searches backward from the last chunk to the first from which a loop can be reached.
  LoopFreeEnd loopFreeEnd() {
    LoopFreeEnd out;
    if (task_.parts > 1) return out;
    uint64_t most = 0;
    for (auto c = static_cast<uint32_t>(partition_.chunks().size()); c-- > 0;) {
      const Chunk& chunk = partition_.chunks()[c];
      if (chunk.routine != task_.entry) continue;
      const Place place{.routine = chunk.routine, .rung = chunk.firstRung};
      most = std::max(most, whole_.from(place));
      if (whole_.leadsToLoop(place)) break;
      out = {.chunk = c, .weight = static_cast<uint32_t>(std::min<uint64_t>(most, UINT32_MAX))};
    }
    return out;
  }

  // Each routine before those that it calls.
  std::vector<RoutinePath> routines() {
    std::vector<RoutinePath> paths{longest_ != nullptr ? longest_->pathFrom(start_) : whole_.pathFrom(start_)};
    std::map<uint32_t, uint32_t> callers; // by routine: calls from routines whose position in the list is not known yet
    std::map<uint32_t, RoutinePath> found;
    std::vector<RoutineId> open = calleesOf(paths[0]);
    while (!open.empty()) {
      const RoutineId routine = open.back();
      open.pop_back();
      if (found.contains(routine.index)) continue;
      RoutinePath& path = found[routine.index] = whole_.pathFrom({.routine = routine});
      path.runs = 0;
      for (const RoutinePath::Call& call : path.calls) ++callers[call.callee.index];
      std::ranges::copy(calleesOf(path), std::back_inserter(open));
    }
    for (const RoutinePath::Call& call : paths[0].calls) ++callers[call.callee.index];
    for (size_t i = 0; i < paths.size(); ++i)
      for (const RoutinePath::Call& call : std::vector(paths[i].calls)) {
        RoutinePath& callee = found[call.callee.index];
        callee.runs = saturatedSum(callee.runs, paths[i].runs);
        if (--callers[call.callee.index] == 0) paths.push_back(callee);
      }
    return paths;
  }

private:
  static std::vector<RoutineId> calleesOf(const RoutinePath& path) {
    std::vector<RoutineId> callees;
    for (const RoutinePath::Call& call : path.calls) callees.push_back(call.callee);
    return callees;
  }

  // A part may begin at any chunk from the end of the one before it.
  void searchParts(std::vector<uint32_t> ends, std::span<const uint64_t> costs) {
    uint32_t begin = 0;
    ends.push_back(RUNG_NONE);
    for (uint32_t i = 0; i < ends.size(); ++i) {
      auto part = std::make_unique<Paths>(partition_, costs, &whole_, ends[i]);
      bool best = false; // so far
      for (uint32_t c = begin; c < std::min<size_t>(ends[i], partition_.chunks().size()); ++c) {
        const Chunk& chunk = partition_.chunks()[c];
        if (chunk.routine != task_.entry) continue;
        const Place start{.routine = chunk.routine, .rung = chunk.firstRung};
        const uint64_t cost = part->from(start);
        if (cost <= cost_) continue;
        best = true;
        start_ = start;
        cost_ = cost;
        part_ = i;
      }
      loops_.insert(loops_.end(), part->loops().begin(), part->loops().end());
      if (best) longest_ = std::move(part);
      begin = ends[i];
    }
  }

  const Partition& partition_;
  const Task& task_;
  Paths whole_;
  std::unique_ptr<Paths> longest_; // of a partitioned task
  Place start_;
  uint64_t cost_ = 0;
  uint32_t part_ = 0;
  std::vector<std::vector<uint32_t>> loops_;
};

} // namespace

LongestRun longestRun(const Partition& partition, TaskId task) {
  const std::vector<uint64_t> weights = rungWeights(partition);
  TaskPaths paths(partition, task, weights);
  return {.weight =
              static_cast<uint32_t>(std::min<uint64_t>(paths.cost(), partition.module().tasks[task.index].budget)),
          .loops = !paths.loops().empty(),
          .loopFree = paths.loopFreeEnd()};
}

LongestPath longestPath(const Partition& partition, TaskId task, std::span<const uint64_t> costs) {
  TaskPaths paths(partition, task, costs);
  return {.cost = paths.cost(), .part = paths.part(), .routines = paths.routines(), .loops = paths.loops()};
}

} // namespace rung::ir
