// Dead operations: a result that is not used is not computed; reading has no effect, so unused loads are removed, too.
// An if or a loop is removed with its contents, including notes, if it has neither an effect nor a used result; results
// of an if are removed one by one. Other notes remain.
#include <algorithm>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/core/regions.h"
#include "ir/transforms/passes.h"
#include "ir/transforms/rewriter.h"

namespace rung::ir {
namespace {

bool hasEffect(const Op& op) { return (opInfo(op.code).effects & (kWrites | kTraps | kHost)) != 0; }

class DeadOps {
public:
  void run(Rung& rung) {
    rung_ = &rung;
    if (findRegions(rung, regions_)) findEffects();
    findUses();
    if (!changes_) return;
    writer_.start(rung);
    for (uint32_t i = 0; i < rung.ops.size(); ++i)
      if (keep_[i] != 0) write(i);
    writer_.finish(rung);
  }

private:
  const Op& op(uint32_t i) const { return rung_->ops[i]; }
  void use(const Op& op, uint32_t k) { used_[rung_->args[op.firstArg + k].index] = 1; }
  void useAll(const Op& op) {
    for (uint32_t k = 0; k < op.argCount; ++k) use(op, k);
  }
  bool isUsed(const Op& op, uint32_t k) const { return used_[op.result.index + k] != 0; }
  bool anyUsed(const Op& op) const {
    for (uint32_t k = 0; k < op.resultCount; ++k)
      if (isUsed(op, k)) return true;
    return false;
  }

  // effect_[i] of an if, else or loop: whether anything in it has an effect; for an if, also in its else.
  void findEffects() {
    effect_.assign(rung_->ops.size(), 0);
    std::vector<uint32_t> open;
    for (uint32_t i = 0; i < rung_->ops.size(); ++i) {
      const OpCode code = op(i).code;
      if (code == OpCode::If || code == OpCode::Loop || code == OpCode::Else) {
        open.push_back(i);
      } else if (code == OpCode::EndIf || code == OpCode::EndLoop) {
        bool effect = false;
        for (bool first = false; !first; open.pop_back()) {
          effect = effect || effect_[open.back()] != 0;
          first = open.back() == regions_[i].begin;
        }
        effect_[regions_[i].begin] = effect ? 1 : 0;
        if (effect && !open.empty()) effect_[open.back()] = 1;
      } else if (!open.empty() && hasEffect(op(i))) {
        effect_[open.back()] = 1;
      }
    }
  }

  void findUses() {
    used_.assign(rung_->values.size(), 0);
    keep_.assign(rung_->ops.size(), 0);
    changes_ = false;
    for (ValueId id : {rung_->transfer.cond, rung_->transfer.value})
      if (id.valid()) used_[id.index] = 1;
    for (uint32_t i = static_cast<uint32_t>(rung_->ops.size()); i-- > 0;) {
      if (decide(i)) {
        keep_[i] = 1;
      } else {
        changes_ = true;
        if (op(i).code == OpCode::Else) // including its notes
          std::fill(keep_.begin() + i, keep_.begin() + regions_[i].end, uint8_t{0});
        else if (op(i).code == OpCode::EndIf || op(i).code == OpCode::EndLoop)
          i = regions_[i].begin; // the whole region
      }
    }
  }

  // Whether operation i is kept; those after it have been decided.
  bool decide(uint32_t i) {
    const Op& o = op(i);
    if (o.code == OpCode::Else) {
      const Op& end = op(regions_[i].end);
      useYields(o, end);
      return effect_[i] != 0 || anyUsed(end);
    }
    if (!isNeeded(i)) return false;
    if (o.code == OpCode::EndIf)
      useYields(o, o);
    else
      useAll(o);
    return true;
  }

  bool isNeeded(uint32_t i) const {
    const Op& o = op(i);
    if (o.code == OpCode::If || o.code == OpCode::Loop) return true; // its end is kept
    if (o.code == OpCode::EndIf || o.code == OpCode::EndLoop) return effect_[regions_[i].begin] != 0 || anyUsed(o);
    return o.code == OpCode::Note || hasEffect(o) || anyUsed(o);
  }

  // Marks as used the operands of an endif or else for which the endif's results are used.
  void useYields(const Op& op, const Op& end) {
    for (uint32_t k = 0; k < op.argCount; ++k) {
      if (isUsed(end, k))
        use(op, k);
      else
        changes_ = true;
    }
  }

  void write(uint32_t i) {
    const Op& o = op(i);
    if (o.code != OpCode::EndIf && o.code != OpCode::Else) {
      writer_.copy(o);
      return;
    }
    const Op& end = o.code == OpCode::EndIf ? o : op(regions_[i].end);
    const uint8_t* first = end.resultCount == 0 ? nullptr : &used_[end.result.index];
    writer_.copySome(o, {first, end.resultCount});
  }

  Rung* rung_ = nullptr;
  RungRewriter writer_;
  std::vector<Region> regions_;
  std::vector<uint8_t> effect_;
  std::vector<uint8_t> used_; // by value
  std::vector<uint8_t> keep_; // by operation
  bool changes_ = false;
};

} // namespace

void removeDeadOps(Module& module, Settled& settled) {
  DeadOps dead;
  settled.eachOpen(module, kDeadRemoved, [&](Rung& rung, uint32_t, uint8_t before) -> uint8_t {
    dead.run(rung);
    return before | kDeadRemoved;
  });
}

} // namespace rung::ir
