// Reuse: an operation without effects that was done before with the same operands is not done again. A load takes the
// value that an earlier load of the same place and type gave, or an earlier store put there, unless something between
// may have written over it. Values of a region are known within it only; writes count from where they are, whether
// their region runs or not; and a loop that writes at all makes everything unknown that was read before it.
#include <algorithm>
#include <utility>

#include "ir/analysis/write_times.h"
#include "ir/core/long_rungs.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/transforms/passes.h"
#include "ir/transforms/rewriter.h"
#include "ir/transforms/value_table.h"

namespace rung::ir {
namespace {

bool isCommutative(OpCode code) {
  return code == OpCode::Add || code == OpCode::Mul || code == OpCode::And || code == OpCode::Or ||
         code == OpCode::Xor || code == OpCode::Eq || code == OpCode::Ne || code == OpCode::FAdd ||
         code == OpCode::FMul || code == OpCode::FEq;
}

// First what is there already is found, for all of a rung; only where there is something the rung is written anew.
class Reuser {
public:
  explicit Reuser(const Module& module) : writes_(module) {}

  // What of the rung is settled then.
  uint8_t run(Rung& rung, uint8_t before) {
    rung_ = &rung;
    reused_.clear();
    tookFromLoop_ = false;
    same_.resize(rung.values.size());
    table_.clear(rung.ops.size());
    writes_.start(rung);
    findWritingLoops();
    for (uint32_t i = 0; i < rung.ops.size(); ++i) {
      if (isReused(i)) reused_.push_back(i);
      if (isLong(rung) && i % kStretch == 0 && !table_.isInRegion()) table_.clear(kStretch);
    }
    if (reused_.empty()) return before | kReused;
    write(rung);
    return tookFromLoop_ ? kNothingSettled : kReused;
  }

private:
  // Whether the results of operation i, or what it stores, are there already.
  bool isReused(uint32_t i) {
    const Op& op = rung_->ops[i];
    const OpInfo& info = opInfo(op.code);
    const uint32_t time = i + 1;
    if (onlyReads(info)) return hasResult(op, info, time);
    for (uint32_t k = 0; k < op.resultCount; ++k) same_[op.result.index + k] = {op.result.index + k};
    if ((info.effects & kWrites) != 0) return isStored(op, time);
    if (op.code == OpCode::Else || op.code == OpCode::EndIf || op.code == OpCode::EndLoop) table_.close();
    if (op.code == OpCode::If || op.code == OpCode::Else || op.code == OpCode::Loop) table_.open();
    if (op.code == OpCode::Loop && writingLoop_[i]) writes_.writeAll(time);
    return false;
  }

  bool hasResult(const Op& op, const OpInfo& info, uint32_t time) {
    const ValueKey key = keyOf(op);
    const ValueTable::Spot spot = table_.find(key);
    const ValueTable::Entry* entry = table_.at(spot);
    if (entry != nullptr && (info.effects != kReads || writes_.unchanged(op, entry->time))) {
      same_[op.result.index] = entry->value;
      return true;
    }
    same_[op.result.index] = op.result;
    table_.enter(spot, key, op.result, time);
    return false;
  }

  // A store of what its place holds already; of others it is known then what the place holds.
  bool isStored(const Op& op, uint32_t time) {
    const bool known = op.code == OpCode::Store || op.code == OpCode::SlotStore;
    if (!known) {
      writes_.write(op, time);
      return false;
    }
    const ValueKey key = keyOf(op);
    const ValueId value = same_[arg(*rung_, op, 0).index];
    const ValueTable::Spot spot = table_.find(key);
    const ValueTable::Entry* entry = table_.at(spot);
    if (entry != nullptr && entry->value == value && writes_.unchanged(op, entry->time)) {
      tookFromLoop_ = tookFromLoop_ || hasLoop_;
      return true;
    }
    writes_.write(op, time);
    table_.enter(spot, key, value, time);
    return false;
  }

  // A store has the key of the load that reads its place.
  ValueKey keyOf(const Op& op) const {
    ValueKey key{.code = op.code, .type = op.type, .ref = op.ref, .count = op.count, .imm = op.imm, .args = {0, 0, 0}};
    if (op.code == OpCode::Store)
      key.code = OpCode::Load;
    else if (op.code == OpCode::SlotStore)
      key.code = OpCode::SlotLoad;
    else
      for (uint32_t i = 0; i < op.argCount; ++i) key.args[i] = same_[rung_->args[op.firstArg + i].index].index;
    if (isCommutative(op.code) && key.args[0] > key.args[1]) std::swap(key.args[0], key.args[1]);
    return key;
  }

  void write(Rung& rung) {
    writer_.start(rung);
    auto next = reused_.begin();
    for (uint32_t i = 0; i < rung.ops.size(); ++i) {
      const Op& op = rung.ops[i];
      if (next == reused_.end() || *next != i) {
        writer_.copy(op);
        continue;
      }
      ++next;
      if (op.resultCount != 0) writer_.replace(op.result, writer_.mapped(same_[op.result.index]));
    }
    writer_.finish(rung);
  }

  void findWritingLoops() {
    hasLoop_ = std::ranges::any_of(rung_->ops, [](const Op& op) { return op.code == OpCode::Loop; });
    if (!hasLoop_) return;
    writingLoop_.assign(rung_->ops.size(), false);
    std::vector<uint32_t> open;
    for (uint32_t i = 0; i < rung_->ops.size(); ++i) {
      const Op& op = rung_->ops[i];
      if (op.code == OpCode::Loop) {
        open.push_back(i);
      } else if (op.code == OpCode::EndLoop) {
        const bool writes = writingLoop_[open.back()];
        open.pop_back();
        if (writes && !open.empty()) writingLoop_[open.back()] = true;
      } else if (!open.empty() && (opInfo(op.code).effects & kWrites) != 0) {
        writingLoop_[open.back()] = true;
      }
    }
  }

  const Rung* rung_ = nullptr;
  std::vector<uint32_t> reused_; // operations that are not done again
  std::vector<ValueId> same_;    // by value: the first that is the same
  ValueTable table_;
  WriteTimes writes_;
  bool hasLoop_ = false;
  std::vector<bool> writingLoop_; // by operation, where there are loops
  bool tookFromLoop_ = false;     // a store, perhaps
  RungRewriter writer_;
};

} // namespace

void reuseValues(Module& module, Settled& settled) {
  Reuser reuser(module);
  settled.eachOpen(module, kReused, [&](Rung& rung, uint32_t, uint8_t before) { return reuser.run(rung, before); });
}

} // namespace rung::ir
