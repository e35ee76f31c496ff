// Context of the current statement.
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

// Marks of contacts and coils.

namespace {

// Whether the instruction only combines values of the equation: LA, LO and LX, whose bits are contacts, and CA.
bool isLogic(const Row& row) {
  constexpr uint16_t kBoth = kReadsRlo | kSetsRlo;
  return (row.effects & kJoins) != 0 || (row.info.group == "bit logic" && (row.effects & kBoth) == kBoth);
}

} // namespace

void Marking::note(ir::MarkKind kind, const Statement& statement, ir::ValueId value) {
  if (marks_ == nullptr) return;
  const RungSource at = sourceOf(program_, statement);
  std::string text(statement.row->info.mnemonic);
  if (statement.tokenCount != 0) text.append(" ").append(spelled(program_.operandTokens(statement)));
  marks_->add(emitter_.out().routine(), emitter_.out().openRung(), {kind, value, at.line, at.column, std::move(text)});
}

void Marking::decision(const Statement& statement) {
  const Row& row = *statement.row;
  if (marks_ == nullptr || (row.effects & kReadsRlo) == 0 || isLogic(row)) return;
  const bool coil = row.info.group == "bit write";
  note(coil ? ir::MarkKind::Coil : ir::MarkKind::Input, statement, emitter_.r().rlo());
}

void Marking::result(const Statement& statement, uint32_t rung) {
  const Row& row = *statement.row;
  const bool asksBit = row.lower == &lowerLoadBit;
  if (marks_ == nullptr || (row.effects & kSetsRlo) == 0 || isLogic(row) || asksBit) return;
  if (emitter_.out().isOpen() && emitter_.out().openRung() == rung)
    note(ir::MarkKind::Result, statement, emitter_.r().rlo());
}

} // namespace rung::frontend::technol
