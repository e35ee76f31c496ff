// Finding timers in the operations of rungs (see timers.h).
#include "ir/layout/timers.h"

#include <algorithm>
#include <optional>
#include <span>

#include "ir/core/memory_use.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"

namespace rung::ir {
namespace {

constexpr uint32_t kNoOp = UINT32_MAX;

bool isLoad(const Op& op) { return op.code == OpCode::Load || op.code == OpCode::SlotLoad; }
bool isStore(const Op& op) { return op.code == OpCode::Store || op.code == OpCode::SlotStore; }
bool isOfSlot(const Op& op) { return opInfo(op.code).attr == Attr::Slot; }

bool samePlace(const Op& a, const Op& b) {
  return isOfSlot(a) == isOfSlot(b) && a.type == b.type && a.ref == b.ref && (isOfSlot(a) || a.imm == b.imm);
}

// ---- where a rung runs -------------------------------------------------------------------------------------------

bool isEntryOfOthers(const Module& module, RoutineId entry) {
  for (uint32_t t = 0; t < module.tasks.size(); ++t)
    if (t != module.mainTask.index && module.tasks[t].entry == entry) return true;
  for (const Routine& routine : module.routines)
    for (const Rung& rung : routine.rungs)
      if (rung.transfer.kind == TransferKind::Call && rung.transfer.callee == entry) return true;
  return false;
}

bool endsElsewhere(const Module& module, RoutineId entry) {
  for (uint32_t r = 0; r < module.routines.size(); ++r) {
    if (r == entry.index) continue;
    for (const Rung& rung : module.routines[r].rungs)
      if (rung.transfer.kind == TransferKind::End) return true;
  }
  return false;
}

// ---- one rung ----------------------------------------------------------------------------------------------------

struct Found {
  const Op* load = nullptr; // of the cell
  SlotId amount;
  bool down = false;
  bool limited = false;
  const Op* limitWord = nullptr;
  int64_t limit = 0; // of it, or by itself
};

class RungMatcher {
public:
  explicit RungMatcher(const Rung& rung)
      : rung_(rung), definition_(rung.values.size(), kNoOp), uses_(rung.values.size()) {
    for (uint32_t i = 0; i < rung.ops.size(); ++i) {
      const Op& op = rung.ops[i];
      for (uint32_t r = 0; r < op.resultCount; ++r) definition_[op.result.index + r] = i;
      for (uint32_t a = 0; a < op.argCount; ++a) uses_[arg(op, a).index].push_back({i, a});
    }
    for (const ValueId value : {rung.transfer.cond, rung.transfer.value})
      if (value.valid()) uses_[value.index].push_back({kNoOp, 0});
  }

  std::vector<Found> find() const {
    std::vector<Found> found;
    for (const Op& op : rung_.ops)
      if (isLoad(op) && (op.type == Type::I32 || op.type == Type::I64))
        if (const std::optional<Found> timer = match(op); timer && isOnlyLoad(op)) found.push_back(*timer);
    return found;
  }

private:
  struct ValueUse {
    uint32_t op;
    uint32_t arg;
  };

  ValueId arg(const Op& op, uint32_t number) const { return rung_.args[op.firstArg + number]; }
  const Op* definitionOf(ValueId value, OpCode code) const {
    const uint32_t at = definition_[value.index];
    return at != kNoOp && rung_.ops[at].code == code ? &rung_.ops[at] : nullptr;
  }
  bool isZero(ValueId value) const {
    const Op* constant = definitionOf(value, OpCode::Const);
    return constant != nullptr && constant->imm == 0;
  }
  bool isOnlyLoad(const Op& load) const {
    return std::ranges::count_if(rung_.ops, [&](const Op& op) { return isLoad(op) && samePlace(op, load); }) == 1;
  }

  std::optional<Found> match(const Op& load) const {
    Found found{.load = &load, .amount = {}};
    const Op* sum = nullptr;
    const Op* compared = nullptr;
    for (const ValueUse& use : uses_[load.result.index]) {
      if (use.op == kNoOp) return std::nullopt;
      const Op& op = rung_.ops[use.op];
      if (op.code == OpCode::LeS && use.arg == 0 && compared == nullptr)
        compared = &op;
      else if (sum == nullptr && (op.code == OpCode::Add || (op.code == OpCode::Sub && use.arg == 0)))
        sum = &op;
      else
        return std::nullopt;
    }
    if (sum == nullptr) return std::nullopt;
    found.down = sum->code == OpCode::Sub;
    const ValueId amount = arg(*sum, 0) == load.result ? arg(*sum, 1) : arg(*sum, 0);
    const Op* const step = definitionOf(amount, OpCode::SlotLoad);
    if (step == nullptr || step->type != load.type) return std::nullopt;
    found.amount = SlotId{step->ref};
    if (found.down ? compared == nullptr || arg(*compared, 1) != amount : compared != nullptr) return std::nullopt;
    return followSum(sum->result, found) && found.limited != found.down ? std::optional(found) : std::nullopt;
  }

  // All that is done with the new value.
  bool followSum(ValueId sum, Found& found) const {
    bool stored = false;
    std::vector<ValueId> values = {sum};
    for (size_t i = 0; i < values.size(); ++i)
      for (const ValueUse& use : uses_[values[i].index]) {
        if (use.op == kNoOp) return false;
        const Op& op = rung_.ops[use.op];
        if (isStore(op) && samePlace(op, *found.load) && i == 0)
          stored = true;
        else if (op.code == OpCode::LtS && use.arg == 0 && isZero(arg(op, 1)))
          continue;
        else if (op.code == OpCode::LeS && use.arg == 1 && !found.down && !found.limited && limitOf(arg(op, 0), found))
          found.limited = true;
        else if ((op.code == OpCode::Else || op.code == OpCode::EndIf) && !found.down)
          values.push_back(resultOf(use));
        else
          return false;
      }
    return stored;
  }

  // What the if gives for a yield of one of its regions.
  ValueId resultOf(const ValueUse& yield) const {
    uint32_t at = yield.op;
    if (rung_.ops[at].code == OpCode::Else)
      for (uint32_t depth = 1; depth != 0;) {
        ++at;
        if (rung_.ops[at].code == OpCode::If) ++depth;
        if (rung_.ops[at].code == OpCode::EndIf) --depth;
      }
    return ValueId{rung_.ops[at].result.index + yield.arg};
  }

  bool limitOf(ValueId value, Found& found) const {
    if (const Op* constant = definitionOf(value, OpCode::Const); constant != nullptr) {
      found.limit = constant->imm;
      return found.limit >= 0 && found.limit <= RUNG_MOST_TIMER_LIMIT;
    }
    found.limit = 1;
    if (const Op* product = definitionOf(value, OpCode::Mul); product != nullptr) {
      const bool second = definitionOf(arg(*product, 1), OpCode::Const) != nullptr;
      const Op* const factor = definitionOf(arg(*product, second ? 1 : 0), OpCode::Const);
      if (factor == nullptr || factor->imm < 0 || factor->imm > RUNG_MOST_TIMER_LIMIT) return false;
      found.limit = factor->imm;
      value = arg(*product, second ? 0 : 1);
    }
    const Op* const wide = definitionOf(value, OpCode::ZExt);
    if (wide == nullptr) return false;
    found.limitWord = definitionOf(arg(*wide, 0), OpCode::Load);
    return found.limitWord != nullptr && found.limitWord->type == Type::I16;
  }

  const Rung& rung_;
  std::vector<uint32_t> definition_; // by value: the operation that gives it
  std::vector<std::vector<ValueUse>> uses_;
};

// ---- the module --------------------------------------------------------------------------------------------------

struct Candidate {
  uint32_t chunk = 0;
  uint32_t rung = 0; // of the main task's entry
  Found found;
  bool alone = true; // nothing else uses the cell
};

class TimerFinder {
public:
  TimerFinder(const MemoryLayout& layout, const Cut& cut)
      : layout_(layout), module_(layout.module()), cut_(cut), timers_(cut.chunks().size()) {}

  std::vector<std::vector<rung_timer>> run(const std::vector<bool>& once) {
    if (once.empty()) return std::move(timers_);
    entry_ = module_.tasks[module_.mainTask.index].entry;
    findCandidates(once);
    if (candidates_.empty()) return std::move(timers_);
    excludeShared();
    for (const Candidate& candidate : candidates_)
      if (candidate.alone) add(candidate);
    return std::move(timers_);
  }

private:
  void findCandidates(const std::vector<bool>& once) {
    for (uint32_t c = 0; c < cut_.chunks().size(); ++c) {
      const Chunk& chunk = cut_.chunks()[c];
      if (chunk.routine != entry_ || !once[chunk.firstRung]) continue;
      for (uint32_t i = chunk.firstRung; i < chunk.firstRung + chunk.rungCount; ++i) {
        if (!once[i]) continue;
        for (const Found& found : RungMatcher(module_.at(entry_).rungs[i]).find()) candidates_.push_back({c, i, found});
      }
    }
  }

  // ---- who else uses the cells

  void excludeShared() {
    for (Candidate& candidate : candidates_) {
      const Op& load = *candidate.found.load;
      if (isOfSlot(load))
        ofSlot_.emplace_back(load.ref, &candidate);
      else
        ofSpace_.emplace_back(placeOf(load), &candidate);
    }
    std::ranges::sort(ofSlot_, {}, [](const auto& entry) { return entry.first; });
    std::ranges::sort(ofSpace_, {}, [](const auto& entry) { return key(entry.first.space, entry.first.first); });
    bool hostReadsAny = false;
    for (uint32_t r = 0; r < module_.routines.size(); ++r)
      for (uint32_t i = 0; i < module_.routines[r].rungs.size(); ++i)
        for (const Op& op : module_.routines[r].rungs[i].ops) {
          exclude(op, r == entry_.index ? i : RUNG_NONE);
          hostReadsAny = hostReadsAny || hostReads(opInfo(op.code));
        }
    if (hostReadsAny)
      for (const auto& [place, candidate] : ofSpace_) candidate->alone = false;
    for (const Task& task : module_.tasks) {
      for (const Copy& copy : task.begin) excludeCopy(copy);
      for (const Copy& copy : task.end) excludeCopy(copy);
    }
  }

  static uint64_t key(SpaceId space, uint32_t bit) { return uint64_t{space.index} << 32 | bit; }
  BitRange placeOf(const Op& op) const { return useOf(module_, op)->place; }

  // Cells that the operation uses, unless it is in the cell's own rung.
  void exclude(const Op& op, uint32_t rung) {
    const auto found = [&](Candidate& candidate) {
      const bool own = candidate.rung == rung && (isLoad(op) || isStore(op)) && samePlace(op, *candidate.found.load);
      candidate.alone = candidate.alone && own;
    };
    if (isOfSlot(op)) {
      const auto slots = std::ranges::equal_range(ofSlot_, op.ref, {}, [](const auto& entry) { return entry.first; });
      for (const auto& [slot, candidate] : slots) found(*candidate);
    } else if (const std::optional<Use> use = useOf(module_, op); use) {
      forCells(use->place, found);
    }
  }

  template <class Visit>
  void forCells(const BitRange& place, Visit visit) {
    constexpr uint32_t kWidest = 64;
    const uint32_t from = place.first < kWidest ? 0 : place.first - kWidest;
    auto at = std::ranges::lower_bound(ofSpace_, key(place.space, from), {},
                                       [](const auto& entry) { return key(entry.first.space, entry.first.first); });
    for (; at != ofSpace_.end() && at->first.space == place.space && at->first.first < place.first + place.count; ++at)
      if (overlap(at->first, place)) visit(*at->second);
  }

  void excludeCopy(const Copy& copy) {
    const auto none = [](Candidate& candidate) { candidate.alone = false; };
    const uint32_t bits = copy.from.size * 8;
    forCells({copy.from.space, copy.from.byte * 8, bits}, none);
    forCells({copy.to, copy.toByte * 8, bits}, none);
    if (copy.masked) forCells({copy.mask, copy.maskByte * 8, bits}, none);
  }

  // ---- tables

  void add(const Candidate& candidate) {
    const Found& found = candidate.found;
    std::vector<rung_timer>& timers = timers_[candidate.chunk];
    if (timers.size() == RUNG_MOST_TIMERS || writesSource(candidate)) return;
    const std::optional<uint32_t> cell = offsetOf(*found.load);
    if (!cell) return;
    rung_timer timer{};
    timer.cell = *cell;
    timer.amount = layout_.slot(found.amount);
    timer.size = byteWidth(found.load->type);
    timer.down = found.down ? 1 : 0;
    timer.limit_cell = RUNG_NONE;
    timer.limit = found.limit;
    if (found.limitWord != nullptr) {
      const std::optional<uint32_t> word = offsetOf(*found.limitWord);
      if (!word) return;
      timer.limit_cell = *word;
    }
    timers.push_back(timer);
  }

  // Nothing where the place does not lie together.
  std::optional<uint32_t> offsetOf(const Op& op) const {
    if (isOfSlot(op)) return layout_.slot(SlotId{op.ref});
    const BitRange place = placeOf(op);
    const std::vector<rung_span> pieces = layout_.pieces({place.space, place.first / 8, place.count / 8});
    if (pieces.size() != 1 || pieces.front().size != place.count / 8) return std::nullopt;
    return pieces.front().offset;
  }

  // The chunk writes the amount or the word of the limit.
  bool writesSource(const Candidate& candidate) const {
    const Chunk& chunk = cut_.chunks()[candidate.chunk];
    const Op* const word = candidate.found.limitWord;
    const auto writes = [&](const Op& op) {
      if ((opInfo(op.code).effects & kWrites) == 0) return false;
      if (isOfSlot(op)) return op.ref == candidate.found.amount.index;
      const std::optional<Use> use = useOf(module_, op);
      return word != nullptr && use && overlap(use->place, placeOf(*word));
    };
    const auto rungs = std::span(module_.at(entry_).rungs).subspan(chunk.firstRung, chunk.rungCount);
    return std::ranges::any_of(rungs, [&](const Rung& rung) { return std::ranges::any_of(rung.ops, writes); });
  }

  const MemoryLayout& layout_;
  const Module& module_;
  const Cut& cut_;
  RoutineId entry_;
  std::vector<Candidate> candidates_;
  std::vector<std::pair<uint32_t, Candidate*>> ofSlot_;  // by slot
  std::vector<std::pair<BitRange, Candidate*>> ofSpace_; // by place
  std::vector<std::vector<rung_timer>> timers_;
};

} // namespace

std::vector<bool> rungsRunOnce(const Module& module) {
  if (!module.mainTask.valid()) return {};
  const Task& task = module.tasks[module.mainTask.index];
  if (task.parts != 1 || isEntryOfOthers(module, task.entry) || endsElsewhere(module, task.entry)) return {};
  const std::vector<Rung>& rungs = module.at(task.entry).rungs;
  const auto count = static_cast<uint32_t>(rungs.size());
  std::vector<bool> once(count, true);
  const auto unsure = [&](uint32_t first, uint32_t end) {
    std::fill(once.begin() + first, once.begin() + std::max(first, end), false);
  };
  for (uint32_t i = 0; i < count; ++i) {
    const Transfer& transfer = rungs[i].transfer;
    const auto jump = [&](uint32_t target) {
      if (target > i)
        unsure(i + 1, target);
      else
        unsure(target, i + 1);
    };
    switch (transfer.kind) {
    case TransferKind::Next:
    case TransferKind::Call: break;
    case TransferKind::Goto: jump(transfer.target); break;
    case TransferKind::Switch: std::ranges::for_each(transfer.targets, jump); break;
    case TransferKind::Ret:
    case TransferKind::End: unsure(i + 1, count); break;
    }
  }
  return once;
}

std::vector<std::vector<rung_timer>> timersOf(const MemoryLayout& layout, const Cut& cut,
                                              const std::vector<bool>& once) {
  return TimerFinder(layout, cut).run(once);
}

} // namespace rung::ir
