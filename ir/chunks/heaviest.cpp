// The longest path through the graph of rungs (see heaviest.h), without recursion: a routine may have 50,000 of them.
#include "ir/chunks/heaviest.h"

#include <algorithm>
#include <vector>

namespace rung::ir {
namespace {

// More than any budget: a few routines that call each other twice have ways of any weight.
uint64_t sum(uint64_t a, uint64_t b) { return std::min(a + b, uint64_t{UINT32_MAX}); }

struct Place {
  RoutineId routine;
  uint32_t rung = 0; // in it
};

// From any rung to the end of its run, its routine, or a part of its task.
class Ways {
public:
  // `callees`: the ways through routines that are called; null: these here. Ways end before the chunk `limit` and those
  // after it.
  Ways(const Cut& cut, Ways* callees, uint32_t limit)
      : cut_(cut), callees_(callees), limit_(limit), marks_(cut.rungCount(), Mark::New), weights_(cut.rungCount(), 0) {}

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
        weights_[number(place)] = weigh(place);
        mark = Mark::Done;
      }
      stack_.pop_back();
    }
    return weights_[number(start)];
  }

  bool circles() const { return circles_; }

private:
  enum class Mark : uint8_t { New, Open, Done };

  uint32_t number(Place place) const { return cut_.rungNumber(place.routine, place.rung); }
  const std::vector<Rung>& rungsOf(RoutineId routine) const { return cut_.module().at(routine).rungs; }

  // The ways from here have to be known first. One that leads back to a rung that is open closes a circle, and counts
  // as ending there.
  void open(Place place) {
    const auto need = [&](Place next) {
      Mark mark = marks_[number(next)];
      if (mark == Mark::New) stack_.push_back(next);
      circles_ = circles_ || mark == Mark::Open;
    };
    const Transfer& transfer = rungsOf(place.routine)[place.rung].transfer;
    if (transfer.kind == TransferKind::Call && callees_ == nullptr) need({.routine = transfer.callee});
    forNext(place, transfer, need);
  }

  uint64_t weigh(Place place) {
    const Rung& rung = rungsOf(place.routine)[place.rung];
    uint64_t most = 0;
    forNext(place, rung.transfer, [&](Place next) { most = std::max(most, weights_[number(next)]); });
    if (rung.transfer.kind == TransferKind::Call) {
      const Place callee{.routine = rung.transfer.callee};
      most = sum(most, callees_ != nullptr ? callees_->from(callee) : weights_[number(callee)]);
    }
    return sum(most, std::max(1u, rung.weight));
  }

  // The rungs of the routine where control may be next, after a call: when it has come back.
  template <class Visit>
  void forNext(Place place, const Transfer& transfer, Visit visit) const {
    const auto go = [&](uint32_t rung) {
      if (rung >= rungsOf(place.routine).size()) return;
      const Destination to = cut_.destination(place.routine, place.rung, rung);
      if (to.inside() || to.chunk < limit_) visit(Place{.routine = place.routine, .rung = rung});
    };
    const bool continues =
        transfer.kind == TransferKind::Next || transfer.kind == TransferKind::Call || transfer.cond.valid();
    if (continues) go(place.rung + 1);
    if (transfer.kind == TransferKind::Goto) go(transfer.target);
    for (const uint32_t target : transfer.targets) go(target);
  }

  const Cut& cut_;
  Ways* callees_;
  uint32_t limit_;
  std::vector<Mark> marks_;       // by rung number
  std::vector<uint64_t> weights_; // 0 as long as they are not known
  bool circles_ = false;
  std::vector<Place> stack_;
};

} // namespace

HeaviestRun heaviestRun(const Cut& cut, TaskId id) {
  const Task& task = cut.module().tasks[id.index];
  Ways whole(cut, nullptr, RUNG_NONE);
  uint64_t most = 0;
  bool circles = false;
  if (task.parts <= 1) {
    most = whole.from({.routine = task.entry});
  } else {
    // A part begins at any chunk from the end of the one before it.
    uint32_t begin = 0;
    std::vector<uint32_t> ends = cut.partEnds(id);
    ends.push_back(RUNG_NONE);
    for (const uint32_t end : ends) {
      Ways part(cut, &whole, end);
      for (uint32_t c = begin; c < std::min<size_t>(end, cut.chunks().size()); ++c) {
        const Chunk& chunk = cut.chunks()[c];
        if (chunk.routine == task.entry)
          most = std::max(most, part.from({.routine = chunk.routine, .rung = chunk.firstRung}));
      }
      circles = circles || part.circles();
      begin = end;
    }
  }
  return {.weight = static_cast<uint32_t>(std::min<uint64_t>(most, task.budget)),
          .circles = circles || whole.circles()};
}

Straight straightEnd(const Cut& cut, TaskId id) {
  const Task& task = cut.module().tasks[id.index];
  Straight out;
  if (task.parts > 1) return out;
  Ways ways(cut, nullptr, RUNG_NONE);
  uint64_t most = 0;
  for (auto c = static_cast<uint32_t>(cut.chunks().size()); c-- > 0;) {
    const Chunk& chunk = cut.chunks()[c];
    if (chunk.routine != task.entry) continue;
    most = std::max(most, ways.from({.routine = chunk.routine, .rung = chunk.firstRung}));
    if (ways.circles()) break;
    out = {.chunk = c, .weight = static_cast<uint32_t>(most)};
  }
  return out;
}

} // namespace rung::ir
