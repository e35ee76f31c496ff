// Writes a rung anew, operation by operation, in order: a pass copies what it keeps, replaces what it knows better and
// leaves out the rest, and operands, values and notes come out dense. One rewriter serves all rungs of a pass.
#pragma once
#include <initializer_list>
#include <span>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

class RungRewriter {
public:
  void start(const Rung& rung);

  // What an old value has become in the new rung; invalid while it has no value there.
  ValueId mapped(ValueId old) const { return mapped_[old.index]; }
  ValueId mappedArg(const Op& op, uint32_t i) const { return mapped(rung_->args[op.firstArg + i]); }
  void replace(ValueId old, ValueId by) { mapped_[old.index] = by; }

  // The operation as it is, with today's operands.
  Op& copy(const Op& op);
  // Another operand for an operation that is written.
  void setArg(const Op& written, uint32_t i, ValueId value) { args_[written.firstArg + i] = value; }
  // The same for an endif or else of which only some yields are kept; keep[i] belongs to operand and result i.
  Op& copySome(const Op& op, std::span<const uint8_t> keep);
  // Another operation in the place of `op`, with new operands and one result or none, which `op`'s result then
  // means.
  Op& put(const Op& op, OpCode code, Type type, std::initializer_list<ValueId> args);
  // One more operation before it, with a result of its own.
  Op& putBefore(const Op& op, OpCode code, Type type, std::initializer_list<ValueId> args);
  ValueId putConstant(const Op& op, Type type, uint64_t bits);

  // An if around what is written between these. The results of its end are what the values `old` mean then.
  void openIf(const Op& at, ValueId cond, BranchWeights branchWeights = kEven);
  void turnElse(const Op& at, std::span<const ValueId> yields);
  void closeIf(const Op& at, std::span<const ValueId> yields, std::span<const ValueId> old);

  // The new operation that gives a value, with its new operands. Valid until the next one is written.
  const Op& definition(ValueId now) const { return ops_[values_[now.index].definedBy]; }
  ValueId arg(const Op& written, uint32_t i) const { return args_[written.firstArg + i]; }
  Type type(ValueId now) const { return values_[now.index].type; }

  // Puts the new operations into the rung, also as conditions of its transfer.
  void finish(Rung& rung);

private:
  struct NewValue {
    Type type;
    uint32_t definedBy; // operation
  };

  Op& append(const Op& op);
  Op& appendOther(const Op& op, OpCode code, Type type, std::span<const ValueId> args);
  // Of the last operation.
  ValueId newValue(Type type) {
    values_.push_back({type, static_cast<uint32_t>(ops_.size()) - 1});
    return {static_cast<uint32_t>(values_.size()) - 1};
  }

  const Rung* rung_ = nullptr;
  std::vector<ValueId> mapped_; // by old value
  std::vector<Op> ops_;
  std::vector<ValueId> args_;
  std::vector<NewValue> values_;
  std::vector<uint32_t> notes_; // the old numbers of the notes that are kept
};

} // namespace rung::ir
