// Mechanisms, block modules, procedures and timed blocks: where control enters and leaves them.
#include <algorithm>

#include <fmt/format.h>

#include "frontend/dialects/technol/lower/lowering.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

// ---- jumps ----------------------------------------------------------------------------------------------------------

uint32_t Lowering::jumpTarget(const Operand& operand) {
  if (codeLabels_[operand.index] == kNone) codeLabels_[operand.index] = out_->newLabel();
  return codeLabels_[operand.index];
}

// ---- sequential units
// ---------------------------------------------------------------------------------------------------

void Lowering::beginSequence(uint32_t mechanism, uint32_t unit) {
  Sequence& sequence = sequences_.emplace_back();
  sequence.unit = unit;
  sequence.routine = out_->routine();
  sequence.mechanism = mechanism;
  ir::Continuation& continuation = sequence.continuation;
  continuation.points = {"beginning"};
  if (mechanism == kNone) {
    const HostCell cell = kind_ == ModuleKind::BlockInit ? HostCell::BlockInitCont : HostCell::BlockDoneCont;
    sequence.moduleCont = place(cell);
    continuation.key = hostCell(cell).name;
    continuation.space = sequence.moduleCont.space;
    continuation.byte = sequence.moduleCont.byte;
  } else {
    continuation.slot = contSlots_[mechanism];
    continuation.key = module_.at(continuation.slot).key;
  }
  sequence.leave = out_->newLabel();
  sequence.dispatch = out_->selectLater(loadCont(sequence));
  sequence.states.push_back(out_->newLabel());
  out_->bind(sequence.states[0]);
}

// The unit has run through: it starts at its beginning the next time.
void Lowering::endSequence() {
  Sequence& sequence = sequences_.back();
  if (sequence.mechanism == kNone) {
    const HostCell done = kind_ == ModuleKind::BlockInit ? HostCell::BlockInitDone : HostCell::BlockDoneDone;
    b().store(place(done), b().bit(true));
  } else {
    b().store({.space = kMechanismSpace, .byte = sequence.mechanism * kMechanismBytes}, b().bit(false));
  }
  storeCont(sequence, b().i32(0));
  storeLine(sequence, 0);
  for (const CountCell& cell : sequence.cells) storeCount(cell, b().constant(cell.type, 0));
  out_->cut();
  out_->setLabels(sequence.dispatch, sequence.states);
  out_->bind(sequence.leave);
  if (sequence.mechanism != kNone) resetCells_[sequence.mechanism] = std::move(sequence.cells);
  module_.continuations.push_back(std::move(sequence.continuation));
  sequences_.pop_back();
}

void Lowering::beginMechanism() {
  const uint32_t mechanism = program_.units[statement_->unit].index;
  out_->cut();
  out_->statement(sourceOf(*statement_));
  const uint32_t byte = mechanism * kMechanismBytes;
  const ValueId inactive = b().not_(b().load(Type::Bit, {.space = kMechanismSpace, .byte = byte}));
  b().if_(inactive);
  b().store({.space = kMechanismSpace, .byte = byte + 1}, b().constant(Type::I16, 0));
  b().endIf();
  const uint32_t leave = out_->newLabel();
  out_->jump(leave, inactive);
  beginSequence(mechanism, statement_->unit);
  sequences_.back().leave = leave;
}

void Lowering::endMechanism() {
  out_->cut();
  out_->statement(sourceOf(*statement_));
  endSequence();
}

// The unit that the statement is in, if it is one that waits; null in a procedure inside it.
Sequence* Lowering::ownSequence() {
  if (sequences_.empty()) return nullptr;
  Sequence& innermost = sequences_.back();
  return program_.owner(statement_->unit) == innermost.unit && innermost.routine == out_->routine() ? &innermost
                                                                                                    : nullptr;
}

uint32_t Lowering::newState(Sequence& sequence, std::string_view role) {
  addPoint(sequence, role);
  sequence.states.push_back(out_->newLabel());
  return static_cast<uint32_t>(sequence.states.size()) - 1;
}

// A point is known by what leads to it: waiting there continues in a new program as long as that is the same.
void Lowering::addPoint(Sequence& sequence, std::string_view role) {
  std::string key = fmt::format("{}@{:016x}", instructionKey(statement_->row->info.mnemonic), sequence.section);
  sequence.sectionEnds = true;
  if (const uint32_t number = sequence.alike[key + std::string(role)]++; number != 0)
    key += "#" + std::to_string(number);
  if (!role.empty()) (key += '/') += role;
  sequence.continuation.points.push_back(std::move(key));
}

uint32_t Lowering::stateOf(Sequence& sequence, uint32_t label) {
  const auto [entry, isNew] = sequence.stateOfLabel.emplace(label, static_cast<uint32_t>(sequence.states.size()));
  if (isNew) {
    addPoint(sequence, "error");
    sequence.states.push_back(label);
  }
  return entry->second;
}

void Lowering::storeCont(const Sequence& sequence, ValueId state) {
  if (sequence.mechanism == kNone)
    b().store(sequence.moduleCont, state);
  else
    b().slotStore(contSlots_[sequence.mechanism], state);
}

ValueId Lowering::loadCont(const Sequence& sequence) {
  if (sequence.mechanism == kNone) return b().load(Type::I32, sequence.moduleCont);
  return b().slotLoad(contSlots_[sequence.mechanism]);
}

void Lowering::storeLine(const Sequence& sequence, uint32_t line) {
  if (sequence.mechanism == kNone) return;
  const uint32_t shown = std::min<uint32_t>(line, UINT16_MAX);
  b().store({.space = kMechanismSpace, .byte = sequence.mechanism * kMechanismBytes + 1},
            b().constant(Type::I16, shown));
}

void Lowering::initMechanism(uint32_t mechanism) {
  const uint32_t byte = mechanism * kMechanismBytes;
  b().store({.space = kMechanismSpace, .byte = byte}, b().bit(false));
  b().store({.space = kMechanismSpace, .byte = byte + 1}, b().constant(Type::I16, 0));
  b().slotStore(contSlots_[mechanism], b().i32(0));
  if (!program_.mechanisms[mechanism].hasTimers) return;
  if (!resets_[mechanism].valid())
    resets_[mechanism] = newRoutine("@MECH_INIT " + symbolKey(program_.mechanisms[mechanism].name));
  out_->call(resets_[mechanism]);
}

// ---- procedures
// -------------------------------------------------------------------------------------------------------

// The normal flow passes a definition by (man. l.1588-1603): its rungs are a routine of their own.
void Lowering::beginProcedure() {
  out_->cut();
  outer_.push_back(std::move(out_));
  outerProcedures_.push_back(procedure_);
  procedure_ = program_.units[statement_->unit].index;
  out_ = newBuilder(procedureRoutines_[procedure_]);
  out_->statement(sourceOf(*statement_));
}

void Lowering::endProcedure() {
  out_->finish();
  out_ = std::move(outer_.back());
  outer_.pop_back();
  procedure_ = outerProcedures_.back();
  outerProcedures_.pop_back();
}

void Lowering::callProcedure(uint32_t procedure, ValueId cond) {
  // The stack of the equation in which the call stands stays as it is.
  std::vector<ir::SlotId> kept;
  for (uint32_t level = 0; level < typed_->stack.depth; ++level) {
    kept.push_back({static_cast<uint32_t>(module_.slots.size())});
    module_.slots.push_back({.type = Type::Bit, .transient = true, .key = "CALL." + std::to_string(kept[level].index)});
    b().slotStore(kept[level], r().stack(level));
  }
  out_->call(procedureRoutines_[procedure], cond);
  for (uint32_t level = 0; level < kept.size(); ++level) r().setStack(level, b().slotLoad(kept[level]));
}

} // namespace rung::frontend::technol
