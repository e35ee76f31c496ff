// Context of the current statement.
#include "frontend/dialects/technol/lower/lowering.h"

#include <algorithm>
#include <utility>

#include "frontend/dialects/technol/lower/lower.h"
#include "ir/core/ops.h"

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

// Timers.

namespace {

// The statement as its author wrote it.
std::string written(const SourceProgram& program, const Statement& statement) {
  std::string text(statement.row->info.mnemonic);
  if (statement.tokenCount != 0) text.append(" ").append(spelled(program.operandTokens(statement)));
  return text;
}

// Sets the preset of a timer if it is a constant or the value of a cell.
void describePreset(const ir::Rung& rung, ValueId value, ir::Timer& timer) {
  for (auto op = rung.ops.rbegin(); op != rung.ops.rend(); ++op) {
    if (op->resultCount != 1 || op->result != value) continue;
    switch (op->code) {
    case ir::OpCode::Const: timer.constant = op->imm; return;
    case ir::OpCode::Load:
      timer.preset = {.type = op->type,
                      .slot = {},
                      .space = ir::SpaceId{op->ref},
                      .byte = static_cast<uint32_t>(static_cast<uint64_t>(op->imm) / 8)};
      return;
    case ir::OpCode::ZExt:
    case ir::OpCode::SExt:
    case ir::OpCode::Trunc: value = ir::arg(rung, *op, 0); break;
    default: return;
    }
  }
}

bool isSame(const ir::TimerCell& a, const ir::TimerCell& b) {
  return a.slot == b.slot && a.space == b.space && a.byte == b.byte;
}

} // namespace

void Lowering::addTimer(const CountCell& cell, ValueId preset) {
  if (!cell.automatic && cell.access.indexed) return;
  ir::Timer timer{.name = written(program.source, statement()), .flags = RUNG_TIMER_RUNS};
  timer.time = {.type = cell.type, .slot = cell.slot, .space = cell.access.place.space, .byte = cell.access.place.byte};
  describePreset(b().rung(), preset, timer);
  std::vector<ir::Timer>& timers = emitter.module().timers;
  const auto other = std::ranges::find_if(timers, [&](const ir::Timer& t) { return isSame(t.time, timer.time); });
  if (other == timers.end()) return timers.push_back(std::move(timer));
  if (other->name == timer.name) return;
  other->name = other->name.substr(0, other->name.find(','));
  other->preset = {};
  other->constant = -1;
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
  marks_->add(emitter_.out().routine(), emitter_.out().openRung(),
              {kind, value, at.line, at.column, written(program_, statement)});
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
