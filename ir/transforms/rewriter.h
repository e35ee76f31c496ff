// Rewrites a rung, operation by operation, in order: a pass copies what it keeps, replaces what it can improve and
// omits the rest; operands, values and notes are renumbered without gaps. One rewriter serves all rungs of a pass.
#pragma once
#include <initializer_list>
#include <span>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

class RungRewriter {
public:
  void start(const Rung& rung);

  // The new value of an old one; invalid as long as there is none.
  ValueId mapped(ValueId old) const { return mapped_[old.index]; }
  ValueId mappedArg(const Op& op, uint32_t i) const { return mapped(rung_->args[op.firstArg + i]); }
  void replace(ValueId old, ValueId by) { mapped_[old.index] = by; }

  // Copies the operation, with mapped operands.
  Op& copy(const Op& op);
  // Replaces an operand of a written operation.
  void setArg(const Op& written, uint32_t i, ValueId value) { args_[written.firstArg + i] = value; }
  // Copies an endif or else with only some of its yields; keep[i] applies to operand and result i.
  Op& copySome(const Op& op, std::span<const uint8_t> keep);
  // Replaces `op` by another operation, with new operands and one result or none, to which the result of `op` is
  // mapped.
  Op& put(const Op& op, OpCode code, Type type, std::initializer_list<ValueId> args);
  // Inserts an operation before it, with a new result.
  Op& putBefore(const Op& op, OpCode code, Type type, std::initializer_list<ValueId> args);
  ValueId putConstant(const Op& op, Type type, uint64_t bits);

  // Writes an if around what is written between these calls. The values `old` are mapped to the results at its end.
  void openIf(const Op& at, ValueId cond, BranchWeights branchWeights = kEven);
  void turnElse(const Op& at, std::span<const ValueId> yields);
  void closeIf(const Op& at, std::span<const ValueId> yields, std::span<const ValueId> old);

  // The new operation that defines a value, with its new operands. Valid until the next one is written.
  const Op& definition(ValueId now) const { return ops_[values_[now.index].definedBy]; }
  ValueId arg(const Op& written, uint32_t i) const { return args_[written.firstArg + i]; }
  Type type(ValueId now) const { return values_[now.index].type; }

  // Replaces the rung's operations by the new ones, and maps the condition of its transfer.
  void finish(Rung& rung);

private:
  struct NewValue {
    Type type;
    uint32_t definedBy; // index of the operation
  };

  Op& append(const Op& op);
  Op& appendOther(const Op& op, OpCode code, Type type, std::span<const ValueId> args);
  // Defined by the last operation.
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
