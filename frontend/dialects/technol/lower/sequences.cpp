// Units that wait (see sequences.h).
#include "frontend/dialects/technol/lower/sequences.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "ir/support/hash.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

ir::Place bitOf(uint32_t mechanism) { return {.space = kMechanismSpace, .byte = mechanism * kMechanismBytes}; }
ir::Place lineOf(uint32_t mechanism) { return {.space = kMechanismSpace, .byte = mechanism * kMechanismBytes + 1}; }

} // namespace

Sequences::Sequences(const SourceProgram& program, Emitter& emitter, State& state)
    : program_(program), emitter_(emitter), state_(state) {
  for (const Mechanism& mechanism : program.mechanisms) {
    const auto number = static_cast<uint32_t>(mechanisms_.size());
    const std::string name = symbolKey(mechanism.name);
    mechanisms_.push_back(
        {.state = emitter.newSlot(Type::I32, "MECH." + name + ".CONT"), .reset = {}, .cells = {}, .tickets = {}});
    state.nameCells("@MECH." + name, bitOf(number), Type::Bit);
    state.nameCells("@MECH." + name + ".LINE", lineOf(number), Type::I16);
  }
}

void Sequences::begin(Sequence sequence) {
  RoutineBuilder& out = emitter_.out();
  sequence.routine = out.routine();
  sequence.continuation.points = {"beginning"};
  if (sequence.leave == kNone) sequence.leave = out.newLabel();
  const ValueId state = loadState(sequence);
  sequence.dispatchRung = out.openRung();
  sequence.dispatch = out.selectLater(state);
  sequence.states.push_back(out.newLabel());
  out.bind(sequence.states[0]);
  open_.push_back(std::move(sequence));
}

void Sequences::beginModule(ModuleKind kind, UnitId unit) {
  const bool init = kind == ModuleKind::BlockInit;
  const HostCell cell = init ? HostCell::BlockInitCont : HostCell::BlockDoneCont;
  Sequence sequence{
      .unit = unit, .routine = {}, .moduleDone = init ? HostCell::BlockInitDone : HostCell::BlockDoneDone};
  sequence.moduleCont = place(cell);
  sequence.continuation.key = hostCell(cell).name;
  sequence.continuation.space = sequence.moduleCont.space;
  sequence.continuation.byte = sequence.moduleCont.byte;
  begin(std::move(sequence));
}

void Sequences::beginMechanism(uint32_t mechanism, UnitId unit) {
  ir::RungBuilder& b = emitter_.b();
  const ValueId inactive = b.not_(b.load(Type::Bit, bitOf(mechanism)));
  b.when(inactive, [&] { b.store(lineOf(mechanism), b.constant(Type::I16, 0)); });
  Sequence sequence{.unit = unit, .routine = {}, .mechanism = mechanism, .leave = emitter_.out().newLabel()};
  emitter_.out().jump(sequence.leave, inactive);
  sequence.continuation.slot = mechanisms_[mechanism].state;
  sequence.continuation.key = emitter_.module().at(sequence.continuation.slot).key;
  begin(std::move(sequence));
}

void Sequences::end() {
  Sequence& sequence = open_.back();
  if (sequence.mechanism == kNone)
    emitter_.b().store(place(sequence.moduleDone), emitter_.b().bit(true));
  else
    emitter_.b().store(bitOf(sequence.mechanism), emitter_.b().bit(false));
  storeState(sequence, emitter_.b().i32(0));
  storeLine(sequence, 0);
  // The cleared state belongs to the instructions above; if versions are compared it does not count as a difference of
  // the end.
  if (!emitter_.isCompared()) clear(sequence.cells, sequence.tickets);
  if (sequence.mechanism == kNone && !sequence.tickets.empty() && !emitter_.isCompared()) clearAtBeginning(sequence);
  emitter_.out().cut();
  emitter_.out().setLabels(sequence.dispatch, sequence.states);
  emitter_.out().bind(sequence.leave);
  if (sequence.mechanism != kNone) {
    Kept& kept = mechanisms_[sequence.mechanism];
    kept.cells = std::move(sequence.cells);
    kept.tickets = std::move(sequence.tickets);
  }
  trace_.push_back({sequence.unit, sequence.continuation.key, sequence.routine, sequence.dispatchRung});
  emitter_.module().continuations.push_back(std::move(sequence.continuation));
  open_.pop_back();
}

void Sequences::clear(std::span<const CountCell> cells, std::span<const ir::SlotId> tickets) {
  for (const CountCell& cell : cells) state_.store(cell, emitter_.b().constant(cell.type, 0));
  for (const ir::SlotId ticket : tickets) emitter_.b().slotStore(ticket, emitter_.b().i32(0));
}

// The control may abort a block and begin the next one: a pending request of the module then belongs to the old block,
// so tickets are cleared at the module's beginning. A module that waits there has no request yet, but may have counted.
void Sequences::clearAtBeginning(Sequence& sequence) {
  RoutineBuilder& out = emitter_.out();
  const uint32_t code = std::exchange(sequence.states[0], out.newLabel());
  out.jump(sequence.leave);
  out.beginOwn();
  out.bind(sequence.states[0]);
  clear({}, sequence.tickets);
  out.jump(code);
}

// Only statements of the unit itself count, not those of a procedure inside it.
void Sequences::pass(const Statement& statement) {
  if (open_.empty()) return;
  Sequence& s = open_.back();
  if (program_.owner(statement.unit) != s.unit || s.routine != emitter_.out().routine()) return;
  s.instruction = instructionKey(program_, statement, statement.row->info.mnemonic);
  s.section = hashBytes(s.instruction, s.sectionEnds ? 0 : s.section);
  s.sectionEnds = false;
}

uint32_t Sequences::newState(Sequence& sequence, std::string_view role) {
  addPoint(sequence, role);
  sequence.states.push_back(emitter_.out().newLabel());
  return static_cast<uint32_t>(sequence.states.size()) - 1;
}

// A waiting point is identified by the instructions that lead to it: a new program continues there if these are the
// same.
void Sequences::addPoint(Sequence& sequence, std::string_view role) {
  std::string key = fmt::format("{}@{:016x}", sequence.instruction, sequence.section);
  sequence.sectionEnds = true;
  if (const uint32_t number = sequence.alike[key + std::string(role)]++; number != 0)
    key += "#" + std::to_string(number);
  if (!role.empty()) (key += '/') += role;
  sequence.continuation.points.push_back(std::move(key));
}

uint32_t Sequences::stateOf(Sequence& sequence, uint32_t label) {
  const auto [entry, isNew] = sequence.stateOfLabel.emplace(label, static_cast<uint32_t>(sequence.states.size()));
  if (isNew) {
    addPoint(sequence, "error");
    sequence.states.push_back(label);
  }
  return entry->second;
}

void Sequences::storeState(const Sequence& sequence, ValueId state) {
  if (sequence.mechanism == kNone)
    emitter_.b().store(sequence.moduleCont, state);
  else
    emitter_.b().slotStore(mechanisms_[sequence.mechanism].state, state);
}

ValueId Sequences::loadState(const Sequence& sequence) {
  if (sequence.mechanism == kNone) return emitter_.b().load(Type::I32, sequence.moduleCont);
  return emitter_.b().slotLoad(mechanisms_[sequence.mechanism].state);
}

void Sequences::storeLine(const Sequence& sequence, uint32_t line) {
  if (sequence.mechanism == kNone) return;
  emitter_.b().store(lineOf(sequence.mechanism), emitter_.given(Type::I16, std::min<uint32_t>(line, UINT16_MAX)));
}

void Sequences::initialise(uint32_t mechanism) {
  ir::RungBuilder& b = emitter_.b();
  b.store(bitOf(mechanism), b.bit(false));
  b.store(lineOf(mechanism), b.constant(Type::I16, 0));
  Kept& kept = mechanisms_[mechanism];
  b.slotStore(kept.state, b.i32(0));
  const Mechanism& info = program_.mechanisms[mechanism];
  if (info.hasTimers && !emitter_.isCompared()) {
    if (!kept.reset.valid()) kept.reset = emitter_.newRoutine("@MECH_INIT " + symbolKey(info.name));
    emitter_.out().call(kept.reset);
  }
  emitter_.out().cut(); // even without a call: rung borders must not depend on the timers of another mechanism
}

void Sequences::makeResets() {
  for (const Kept& kept : mechanisms_) {
    if (!kept.reset.valid()) continue;
    emitter_.open(kept.reset);
    clear(kept.cells, kept.tickets);
    emitter_.close();
  }
}

} // namespace rung::frontend::technol
