// Partitions rungs into chunks (see partition.h).
#include "ir/shape/partition.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "ir/support/check.h"

namespace rung::ir {
namespace {

constexpr uint32_t kNear = 8; // places within this fraction of a chunk are near one another

uint32_t weightOf(const Rung& rung) { return std::max(1u, rung.weight); }
bool leavesRoutine(TransferKind kind) {
  return kind == TransferKind::Call || kind == TransferKind::Ret || kind == TransferKind::End;
}

} // namespace

// Fills a Partition step by step.
class Partitioner {
public:
  Partitioner(Partition& partition, const PartitionOptions& options)
      : partition_(partition), module_(*partition.module_), options_(options) {}

  void run() {
    numberRungs();
    for (uint32_t r = 0; r < module_.routines.size(); ++r) cutRoutine(r);
    findPartEnds();
  }

private:
  void numberRungs() {
    uint32_t number = 0;
    for (const Routine& routine : module_.routines) {
      partition_.firstRung_.push_back(number);
      number += static_cast<uint32_t>(routine.rungs.size());
    }
    partition_.rungCount_ = number;
  }

  void cutRoutine(uint32_t routine) {
    const std::vector<Rung>& rungs = module_.routines[routine].rungs;
    markHeads(routine);
    measure(rungs);
    std::vector<uint32_t>& chunkOf = partition_.chunkOfRung_.emplace_back();
    partition_.after_.emplace_back(rungs.size());
    const auto count = static_cast<uint32_t>(rungs.size());
    for (uint32_t first = 0; first < count;) {
      const uint32_t end = chunkEnd(routine, first);
      chunkOf.insert(chunkOf.end(), end - first, static_cast<uint32_t>(partition_.chunks_.size()));
      partition_.chunks_.push_back({.routine = RoutineId{routine}, .firstRung = first, .rungCount = end - first});
      for (uint32_t i = first; i < end; ++i)
        forTargets(rungs[i].transfer, [&](uint32_t target) {
          if (target >= end) heads_[target] = true;
        });
      weigh(rungs, partition_.chunks_.back());
      first = end;
    }
  }

  // The rungs of a routine that must begin a chunk, wherever the others begin.
  void markHeads(uint32_t routine) {
    const std::vector<Rung>& rungs = module_.routines[routine].rungs;
    heads_.assign(rungs.size() + 1, false);
    heads_[0] = true;
    for (const Task& task : module_.tasks) // the rungs before which a part ends
      if (task.entry.index == routine)
        for (const uint32_t rung : task.borders) heads_[rung] = true;
    for (uint32_t i = 0; i < rungs.size(); ++i) {
      if (rungs[i].transfer.kind == TransferKind::Call) heads_[i + 1] = true;
      forTargets(rungs[i].transfer, [&](uint32_t target) {
        if (target <= i) heads_[target] = true;
      });
    }
  }

  void weigh(const std::vector<Rung>& rungs, Chunk& chunk) {
    const uint32_t end = chunk.firstRung + chunk.rungCount;
    std::vector<uint32_t>& after = partition_.after_[chunk.routine.index];
    for (uint32_t i = end; i-- > chunk.firstRung;) {
      const Transfer& transfer = rungs[i].transfer;
      uint32_t least = UINT32_MAX;
      const auto way = [&](uint32_t to) {
        least = to <= i || to >= end ? 0 : std::min(least, weightOf(rungs[to]) + after[to]);
      };
      if (transfer.kind == TransferKind::Next || transfer.cond.valid()) way(i + 1);
      forTargets(transfer, way);
      after[i] = least == UINT32_MAX ? 0 : least; // outside of the routine: back to the caller, or the run's end
      if (leavesRoutine(transfer.kind)) after[i] = 0;
    }
    chunk.weight = weightOf(rungs[chunk.firstRung]) + after[chunk.firstRung];
  }

  // For chunkEnd: the number of operations before each rung, and of jumps across the border before it.
  void measure(const std::vector<Rung>& rungs) {
    opsBefore_.assign(1, 0);
    crossing_.assign(rungs.size() + 2, 0);
    for (uint32_t i = 0; i < rungs.size(); ++i) {
      opsBefore_.push_back(opsBefore_.back() + rungs[i].ops.size());
      forTargets(rungs[i].transfer, [&](uint32_t target) {
        if (target <= i + 1) return;
        ++crossing_[i + 1];
        --crossing_[target];
      });
    }
    std::partial_sum(crossing_.begin(), crossing_.end(), crossing_.begin());
  }

  // The chunk from `first` up to the rung before `end`.
  bool isFull(uint32_t first, uint32_t end) const {
    return end - first >= options_.maxChunkRungs || opsBefore_[end + 1] - opsBefore_[first] > options_.maxChunkOps;
  }

  // A full chunk is divided in its second half, as late as possible, at a border that the fewest jumps cross; among
  // such borders near one another, the rungs' keys choose, so that inserting a rung above moves one border or two, and
  // not all later ones.
  uint32_t chunkEnd(uint32_t routine, uint32_t first) const {
    const std::vector<Rung>& rungs = module_.routines[routine].rungs;
    const auto count = static_cast<uint32_t>(rungs.size());
    uint32_t end = first + 1;
    while (end < count && !heads_[end] && !isFull(first, end)) ++end;
    if (end == count || heads_[end]) return end;
    const uint32_t earliest = first + (end - first) / 2 + 1;
    uint32_t best = end;
    for (uint32_t i = end; i >= earliest; --i)
      if (crossing_[i] < crossing_[best]) best = i;
    uint32_t chosen = best;
    for (uint32_t i = best; i >= earliest && best - i < (end - first) / kNear; --i)
      if (crossing_[i] == crossing_[best] && rungs[i].key < rungs[chosen].key) chosen = i;
    return chosen;
  }

  template <class Visit>
  static void forTargets(const Transfer& transfer, Visit visit) {
    if (transfer.kind == TransferKind::Goto) visit(transfer.target);
    for (uint32_t target : transfer.targets) visit(target);
  }

  void findPartEnds() {
    for (size_t t = 0; t < module_.tasks.size(); ++t) {
      std::vector<uint32_t>& ends = partition_.partEnds_.emplace_back();
      for (uint32_t rung : module_.tasks[t].borders) ends.push_back(partition_.chunkAt(module_.tasks[t].entry, rung));
    }
  }

  Partition& partition_;
  const Module& module_;
  PartitionOptions options_;
  // Of the current routine, by rung.
  std::vector<bool> heads_;
  std::vector<int32_t> crossing_;
  std::vector<size_t> opsBefore_;
};

Partition::Partition(const Module& module, const PartitionOptions& options) : module_(&module) {
  Partitioner(*this, options).run();
}

namespace {

bool mayGoOn(const Transfer& transfer) {
  return transfer.kind == TransferKind::Next || transfer.kind == TransferKind::Call || transfer.cond.valid();
}
bool mayJumpTo(const Transfer& transfer, uint32_t rung) {
  return (transfer.kind == TransferKind::Goto && transfer.target == rung) ||
         std::ranges::find(transfer.targets, rung) != transfer.targets.end();
}

// Whether control leaves a rung only by exits that the rung of the shape has.
bool hasExitsOf(const Transfer& code, const Transfer& shape, uint32_t next) {
  const auto shapeGoesTo = [&](uint32_t rung) { return mayJumpTo(shape, rung) || (rung == next && mayGoOn(shape)); };
  if (leavesRoutine(code.kind) && (code.kind != shape.kind || code.callee != shape.callee)) return false;
  if (mayGoOn(code) && !shapeGoesTo(next)) return false;
  if (code.kind == TransferKind::Goto && !shapeGoesTo(code.target)) return false;
  return std::ranges::all_of(code.targets, shapeGoesTo);
}

} // namespace

Partition Partition::over(const Module& module) const {
  RUNG_CHECK(module.routines.size() == module_->routines.size(), "another form of a module has its routines");
  for (size_t r = 0; r < module.routines.size(); ++r) {
    const std::vector<Rung>& code = module.routines[r].rungs;
    const std::vector<Rung>& shape = module_->routines[r].rungs;
    RUNG_CHECK(code.size() == shape.size(), "another form of a routine has its rungs");
    for (uint32_t i = 0; i < code.size(); ++i)
      RUNG_CHECK(hasExitsOf(code[i].transfer, shape[i].transfer, i + 1), "a rung has an exit that its shape has not");
  }
  Partition other = *this;
  other.module_ = &module;
  return other;
}

uint32_t Partition::chunkAt(RoutineId routine, uint32_t rung) const {
  const uint32_t chunk = chunkOfRung_[routine.index][rung];
  RUNG_CHECK(chunks_[chunk].firstRung == rung, "control may enter a chunk at its head only");
  return chunk;
}

Destination Partition::destination(RoutineId routine, uint32_t from, uint32_t to) const {
  const std::vector<uint32_t>& chunkOf = chunkOfRung_[routine.index];
  if (to <= from || chunkOf[to] != chunkOf[from]) return {.chunk = chunkAt(routine, to)};
  const std::vector<uint32_t>& after = after_[routine.index];
  return {
      .chunk = chunkOf[to], .rung = to, .extra = weightOf(module_->at(routine).rungs[to]) + after[to] - after[from]};
}

Exit exitOf(const Partition& partition, RoutineId routine, uint32_t rung) {
  const std::vector<Rung>& rungs = partition.module().at(routine).rungs;
  const Transfer& transfer = rungs[rung].transfer;
  Exit exit{.kind = transfer.kind,
            .cond = transfer.cond,
            .value = transfer.value,
            .taken = {},
            .otherwise = {},
            .targets = {}};
  const bool goesOn =
      transfer.kind == TransferKind::Next || transfer.kind == TransferKind::Call || transfer.cond.valid();
  if (goesOn && rung + 1 < rungs.size()) exit.otherwise = partition.destination(routine, rung, rung + 1);
  if (transfer.kind == TransferKind::Goto) exit.taken = partition.destination(routine, rung, transfer.target);
  if (transfer.kind == TransferKind::Call) exit.taken = {.chunk = partition.entry(transfer.callee)};
  for (uint32_t target : transfer.targets) exit.targets.push_back(partition.destination(routine, rung, target));
  return exit;
}

} // namespace rung::ir
