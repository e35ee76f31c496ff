// Order: operations are put in the order of the source's lines, and within a line in the order of need: operands
// precede the first operation that needs them, operand by operand. Front ends build a rung by nested calls, and C++
// leaves the order of evaluation of arguments to the compiler: without this pass the same source would give a different
// module with every build of this compiler. Operations with effects keep their places, and those without effects stay
// between the same two of them.
#include <algorithm>
#include <utility>

#include "ir/core/op_info.h"
#include "ir/transforms/passes.h"
#include "ir/transforms/rewriter.h"

namespace rung::ir {
namespace {

bool mayMove(const Op& op) { return op.resultCount == 1 && onlyReads(opInfo(op.code)); }

class RungOrder {
public:
  void run(Rung& rung) {
    rung_ = &rung;
    number();
    arrange();
    changed_ = !std::ranges::is_sorted(order_);
    if (!changed_) return;
    writer_.start(rung);
    for (const uint32_t op : order_) writer_.copy(rung.ops[op]);
    writer_.finish(rung);
  }
  bool changed() const { return changed_; }
  ValueId mapped(ValueId old) const { return writer_.mapped(old); }

private:
  static constexpr uint32_t kNone = RUNG_NONE;
  // The sort key of an operation; not set: it does not move, or has no number yet.
  struct Need {
    uint32_t line = 0;
    uint32_t number = kNone;
    bool isSet() const { return number != kNone; }
    auto operator<=>(const Need&) const = default;
  };

  // Numbers operations in the order of need: by those with an effect, from the first to the last, and by the exit.
  void number() {
    const std::vector<Op>& ops = rung_->ops;
    needed_.assign(ops.size(), {});
    definedBy_.assign(rung_->values.size(), kNone);
    next_ = 0;
    for (uint32_t i = 0; i < ops.size(); ++i)
      if (mayMove(ops[i])) definedBy_[ops[i].result.index] = i;
    for (const Op& op : ops)
      if (!mayMove(op))
        for (uint32_t k = 0; k < op.argCount; ++k) need(rung_->args[op.firstArg + k]);
    need(rung_->transfer.cond);
    need(rung_->transfer.value);
    for (uint32_t value = 0; value < rung_->values.size(); ++value) need({value}); // unused values
  }

  // Numbers operands before the operation, without recursion: rungs may be long.
  void need(ValueId value) {
    if (!value.valid() || !isOpen(value)) return;
    path_.emplace_back(definedBy_[value.index], 0);
    while (!path_.empty()) {
      auto& [at, operand] = path_.back();
      const Op& op = rung_->ops[at];
      while (operand < op.argCount && !isOpen(rung_->args[op.firstArg + operand])) ++operand;
      if (operand < op.argCount) {
        path_.emplace_back(definedBy_[rung_->args[op.firstArg + operand].index], 0);
        continue;
      }
      needed_[at] = {lineOf(op), next_++};
      path_.pop_back();
    }
  }

  // The line of an operation, or of an operand if that is further down.
  uint32_t lineOf(const Op& op) const {
    uint32_t line = op.line;
    for (uint32_t k = 0; k < op.argCount; ++k)
      if (const uint32_t by = definedBy_[rung_->args[op.firstArg + k].index]; by != kNone)
        line = std::max(line, needed_[by].line);
    return line;
  }
  bool isOpen(ValueId value) const {
    const uint32_t op = definedBy_[value.index];
    return op != kNone && !needed_[op].isSet();
  }

  void arrange() {
    const std::vector<Op>& ops = rung_->ops;
    order_.resize(ops.size());
    for (uint32_t i = 0; i < ops.size(); ++i) order_[i] = i;
    for (uint32_t begin = 0; begin < ops.size();) {
      uint32_t end = begin;
      while (end < ops.size() && mayMove(ops[end])) ++end;
      std::sort(order_.begin() + begin, order_.begin() + end,
                [&](uint32_t a, uint32_t b) { return needed_[a] < needed_[b]; });
      begin = end + 1;
    }
  }

  Rung* rung_ = nullptr;
  std::vector<Need> needed_;        // by operation
  std::vector<uint32_t> definedBy_; // by value: a movable operation
  uint32_t next_ = 0;
  std::vector<std::pair<uint32_t, uint32_t>> path_; // an operation, and the operand to be numbered next
  std::vector<uint32_t> order_;
  bool changed_ = false;
  RungRewriter writer_;
};

} // namespace

void orderOperations(Module& module, Marks* marks, GivenNumbers* given) {
  RungOrder order;
  for (uint32_t r = 0; r < module.routines.size(); ++r)
    for (uint32_t i = 0; i < module.routines[r].rungs.size(); ++i) {
      order.run(module.routines[r].rungs[i]);
      if (!order.changed()) continue;
      if (marks != nullptr)
        for (Mark& mark : marks->of(RoutineId{r}, i)) mark.value = order.mapped(mark.value);
      if (given != nullptr)
        for (GivenNumber& number : given->of(RoutineId{r}, i)) number.value = order.mapped(number.value);
    }
}

} // namespace rung::ir
