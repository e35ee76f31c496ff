// Rewrites a rung (see rewriter.h).
#include "ir/transforms/rewriter.h"

#include <utility>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"

namespace rung::ir {

void RungRewriter::start(const Rung& rung) {
  rung_ = &rung;
  mapped_.assign(rung.values.size(), ValueId{});
  ops_.clear();
  args_.clear();
  values_.clear();
  notes_.clear();
}

// Appends the operation without operands and results.
Op& RungRewriter::append(const Op& op) {
  Op& added = ops_.emplace_back(op);
  added.firstArg = static_cast<uint32_t>(args_.size());
  added.argCount = 0;
  added.resultCount = 0;
  added.result = {};
  return added;
}

Op& RungRewriter::copy(const Op& op) {
  Op& added = ops_.emplace_back(op);
  added.firstArg = static_cast<uint32_t>(args_.size());
  for (uint32_t i = 0; i < op.argCount; ++i) args_.push_back(mappedArg(op, i));
  if (op.resultCount != 0) added.result = {static_cast<uint32_t>(values_.size())};
  for (uint32_t i = 0; i < op.resultCount; ++i) {
    const ValueId old{op.result.index + i};
    replace(old, newValue(rung_->values[old.index]));
  }
  if (op.code == OpCode::Note) {
    added.ref = static_cast<uint32_t>(notes_.size());
    notes_.push_back(op.ref);
  }
  return added;
}

Op& RungRewriter::copySome(const Op& op, std::span<const uint8_t> keep) {
  Op& added = append(op);
  for (uint32_t i = 0; i < op.argCount; ++i) {
    if (keep[i] == 0) continue;
    args_.push_back(mappedArg(op, i));
    ++added.argCount;
    if (op.resultCount == 0) continue;
    const ValueId old{op.result.index + i};
    const ValueId id = newValue(rung_->values[old.index]);
    replace(old, id);
    if (added.resultCount++ == 0) added.result = id;
  }
  return added;
}

Op& RungRewriter::appendOther(const Op& op, OpCode code, Type type, std::span<const ValueId> args) {
  Op& added = append(op);
  added.code = code;
  added.type = type;
  added.ref = 0;
  added.count = 0;
  added.imm = 0;
  added.argCount = static_cast<uint16_t>(args.size());
  args_.insert(args_.end(), args.begin(), args.end());
  return added;
}

Op& RungRewriter::put(const Op& op, OpCode code, Type type, std::initializer_list<ValueId> args) {
  Op& added = appendOther(op, code, type, {args.begin(), args.size()});
  if (op.resultCount == 0) return added;
  added.result = newValue(rung_->values[op.result.index]);
  added.resultCount = 1;
  replace(op.result, added.result);
  return added;
}

Op& RungRewriter::putBefore(const Op& op, OpCode code, Type type, std::initializer_list<ValueId> args) {
  Op& added = appendOther(op, code, type, {args.begin(), args.size()});
  added.result = newValue(resultType(opInfo(code).result, type));
  added.resultCount = 1;
  return added;
}

ValueId RungRewriter::putConstant(const Op& op, Type type, uint64_t bits) {
  Op& added = putBefore(op, OpCode::Const, type, {});
  added.imm = static_cast<int64_t>(bits);
  return added.result;
}

void RungRewriter::openIf(const Op& at, ValueId cond, BranchWeights branchWeights) {
  appendOther(at, OpCode::If, Type::None, {&cond, 1}).ref = branchWeights;
}

void RungRewriter::turnElse(const Op& at, std::span<const ValueId> yields) {
  appendOther(at, OpCode::Else, Type::None, yields);
}

void RungRewriter::closeIf(const Op& at, std::span<const ValueId> yields, std::span<const ValueId> old) {
  Op& added = appendOther(at, OpCode::EndIf, Type::None, yields);
  added.resultCount = static_cast<uint16_t>(old.size());
  for (size_t i = 0; i < old.size(); ++i) {
    const ValueId id = newValue(rung_->values[old[i].index]);
    replace(old[i], id);
    if (i == 0) added.result = id;
  }
}

void RungRewriter::finish(Rung& rung) {
  Transfer& transfer = rung.transfer;
  if (transfer.cond.valid()) transfer.cond = mapped(transfer.cond);
  if (transfer.value.valid()) transfer.value = mapped(transfer.value);
  // Copied, not swapped, so that a small rung does not keep the storage of a large one.
  rung.ops.assign(ops_.begin(), ops_.end());
  rung.args.assign(args_.begin(), args_.end());
  rung.values.resize(values_.size());
  for (size_t i = 0; i < values_.size(); ++i) rung.values[i] = values_[i].type;
  // Notes keep their order, so each moves down or stays.
  for (uint32_t i = 0; i < notes_.size(); ++i)
    if (notes_[i] != i) rung.notes[i] = std::move(rung.notes[notes_[i]]);
  rung.notes.resize(notes_.size());
}

} // namespace rung::ir
