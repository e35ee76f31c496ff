// Folding: operations with known operands become constants (by the common evaluator, eval.h), others are simplified
// (simplify.cpp); of an `if` with a known condition only the region that runs is kept; loops of one iteration are
// replaced by their contents, loops of none are removed; and transfers with a known condition or number become
// unconditional.
#include "ir/core/ops.h"
#include "ir/core/regions.h"
#include "ir/transforms/passes.h"
#include "ir/transforms/rewriter.h"
#include "ir/transforms/simplify.h"

namespace rung::ir {
namespace {

class Folder {
public:
  explicit Folder(const Module& module) : module_(module) {}

  // Whether it has changed the rung.
  bool run(Rung& rung, uint32_t number) {
    rung_ = &rung;
    changed_ = false;
    writer_.start(rung);
    findRegions(rung, regions_);
    // Each call returns the last operation that it has handled.
    for (uint32_t i = 0; i < rung.ops.size(); ++i) i = fold(i);
    if (changed_) writer_.finish(rung);
    foldTransfer(rung.transfer, number);
    return changed_;
  }

private:
  // An open region. Inlined: its brackets are not written.
  struct Frame {
    bool inlined;
    std::vector<ValueId> yields; // of the first region of an if that is written
  };

  const Op& op(uint32_t i) const { return rung_->ops[i]; }
  // Maps the results of operation i, from the result `skip` on, to the operands of `from`.
  void resultsAre(uint32_t i, const Op& from, uint32_t skip = 0) {
    for (uint32_t k = 0; k < from.argCount; ++k)
      writer_.replace({op(i).result.index + skip + k}, writer_.mappedArg(from, k));
  }

  uint32_t fold(uint32_t i) {
    const OpCode code = op(i).code;
    if (code == OpCode::If) return beginIf(i);
    if (code == OpCode::Else) return divideIf(i);
    if (code == OpCode::Loop) return beginLoop(i);
    if (code == OpCode::EndIf)
      endIf(i);
    else if (code == OpCode::EndLoop)
      endLoop(i);
    else if (simplify(module_, writer_, op(i)))
      changed_ = true;
    else
      writer_.copy(op(i));
    return i;
  }

  uint32_t beginIf(uint32_t i) {
    uint64_t cond = 0;
    if (!isConstant(writer_, writer_.mappedArg(op(i), 0), cond)) {
      writer_.copy(op(i));
      open_.push_back({.inlined = false, .yields = {}});
      return i;
    }
    changed_ = true;
    const uint32_t end = regions_[i].end;
    if (cond == 0 && op(end).code == OpCode::EndIf) return end;
    open_.push_back({.inlined = true, .yields = {}});
    return cond == 0 ? end : i;
  }

  uint32_t divideIf(uint32_t i) {
    if (open_.back().inlined) { // the first region runs
      const uint32_t end = regions_[i].end;
      resultsAre(end, op(i));
      open_.pop_back();
      return end;
    }
    for (uint32_t k = 0; k < op(i).argCount; ++k) open_.back().yields.push_back(writer_.mappedArg(op(i), k));
    writer_.copy(op(i));
    return i;
  }

  void endIf(uint32_t i) {
    if (open_.back().inlined) {
      resultsAre(i, op(i));
    } else {
      writer_.copy(op(i));
      // If both regions yield the same value, it existed before.
      for (uint32_t k = 0; k < op(i).argCount; ++k)
        if (const ValueId yield = writer_.mappedArg(op(i), k); yield == open_.back().yields[k]) {
          writer_.replace({op(i).result.index + k}, yield);
          changed_ = true;
        }
    }
    open_.pop_back();
  }

  uint32_t beginLoop(uint32_t i) {
    changed_ = changed_ || op(i).count <= 1;
    if (op(i).count == 0) {
      resultsAre(regions_[i].end, op(i));
      return regions_[i].end;
    }
    const bool once = op(i).count == 1;
    if (once) {
      writer_.replace(op(i).result, writer_.putConstant(op(i), Type::I32, 0));
      resultsAre(i, op(i), 1);
    } else {
      writer_.copy(op(i));
    }
    open_.push_back({.inlined = once, .yields = {}});
    return i;
  }

  void endLoop(uint32_t i) {
    if (open_.back().inlined)
      resultsAre(i, op(i));
    else
      writer_.copy(op(i));
    open_.pop_back();
  }

  void foldTransfer(Transfer& transfer, uint32_t number) {
    uint64_t bits = 0;
    if (transfer.value.valid() && isConstant(writer_, transfer.value, bits)) {
      const uint32_t target = transfer.targets[bits < transfer.targets.size() ? bits : 0];
      changed_ = true;
      transfer = {.kind = TransferKind::Goto, .target = target};
    }
    if (transfer.cond.valid() && isConstant(writer_, transfer.cond, bits)) {
      changed_ = true;
      transfer.cond = {};
      if (bits == 0) transfer = {};
    }
    if (transfer.kind != TransferKind::Goto || transfer.target != number + 1) return;
    changed_ = true;
    transfer = {};
  }

  const Module& module_;
  Rung* rung_ = nullptr;
  RungRewriter writer_;
  std::vector<Region> regions_;
  std::vector<Frame> open_;
  bool changed_ = false;
};

} // namespace

void foldConstants(Module& module, Settled& settled) {
  Folder folder(module);
  settled.eachOpen(module, kFolded, [&](Rung& rung, uint32_t number, uint8_t before) -> uint8_t {
    return folder.run(rung, number) ? kNothingSettled : before | kFolded;
  });
}

} // namespace rung::ir
