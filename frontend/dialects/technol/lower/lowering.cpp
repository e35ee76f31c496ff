// The current statement (see context.h).
#include "frontend/dialects/technol/lower/lowering.h"

#include "frontend/dialects/technol/lower/lower.h"

namespace rung::frontend::technol {

using ir::ValueId;

void Lowering::enter(const Statement& statement, const Typed& typed) {
  statement_ = &statement;
  typed_ = &typed;
}

void Lowering::useStack() {
  const StackUse& use = typed_->stack;
  if (use.pushed != kNone) r().setStack(use.pushed, r().rlo());
  popped_ = use.popped == kNone ? ValueId{} : r().stack(use.popped);
}

uint32_t Lowering::labelOf(uint32_t label) {
  if (labels_[label] == kNone) labels_[label] = emitter.out().newLabel();
  return labels_[label];
}

ValueId Lowering::guardOf(int condition) {
  if (condition == kAlways) return {};
  return condition == kIfRlo ? r().rlo() : b().not_(r().rlo());
}

ValueId Lowering::contact(const Operand& operand) {
  const ValueId value = memory.bit(operand);
  marking.contact(*statement_, value);
  return value;
}

} // namespace rung::frontend::technol
