// Timed blocks (see clocks.h).
#include "frontend/dialects/technol/lower/clocks.h"

#include <algorithm>

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

// Values of the slot CLOCK while a module runs; a procedure uses the clock of its caller.
enum : int32_t { kMainClock = 0, kFastClock = 1, kNoClock = 2 };

// Whether the module is outside the cycle: no period has passed when it runs.
bool runsOnce(ModuleKind kind) {
  return kind == ModuleKind::Init || kind == ModuleKind::Done || kind == ModuleKind::Clear || kind == ModuleKind::Halt;
}

std::string keyOf(bool fast, size_t kind) {
  return std::string(fast ? "FAST" : "MAIN") + ".DFTM" + std::to_string(kind);
}

} // namespace

Clocks::Clocks(const SourceProgram& program, Emitter& emitter, State& state, uint32_t periodUs)
    : program_(program), emitter_(emitter), state_(state), periodUs_(periodUs) {
  for (const Unit& unit : program.units)
    if (unit.kind == UnitKind::Timed) find(unit);
}

void Clocks::find(const Unit& timed) {
  const Unit* around = &timed; // the module or procedure that contains it
  while (around->kind != UnitKind::Procedure && around->parent.valid()) around = &program_.at(around->parent);
  const bool inProcedure = around->kind == UnitKind::Procedure;
  if (inProcedure && !clock_.valid()) clock_ = emitter_.newSlot(Type::I32, "CLOCK");
  for (const bool fast : {false, true})
    if (inProcedure || (!runsOnce(around->module) && isFast(around->module) == fast))
      used_[fast ? 1 : 0][static_cast<size_t>(findRow(timed.name)->variant)] = true;
}

// The module that runs first in each millisecond advances the fast clock.
ModuleKind Clocks::firstFast() const {
  for (const ModuleKind kind : {ModuleKind::Cyclic, ModuleKind::Fastest})
    for (const ModulePart& part : program_.parts)
      if (part.kind == kind) return kind;
  return ModuleKind::Fast;
}

void Clocks::enter(ModuleKind kind) {
  if (clock_.valid() && (isFast(kind) || runsOnce(kind))) set(isFast(kind) ? kFastClock : kNoClock);
  if (kind == ModuleKind::Input) advance(false);
  if (kind == firstFast()) advance(true);
}

void Clocks::leave(ModuleKind kind) {
  if (clock_.valid() && (isFast(kind) || runsOnce(kind))) set(kMainClock);
}

void Clocks::set(int32_t clock) {
  emitter_.out().cut();
  emitter_.b().slotStore(clock_, emitter_.b().i32(clock));
  emitter_.out().cut();
}

void Clocks::callEvent(ir::RoutineId procedure) {
  const bool timed = clock_.valid();
  if (timed) emitter_.b().slotStore(clock_, emitter_.b().i32(kNoClock));
  emitter_.out().call(procedure);
  if (timed) set(kMainClock);
}

// Advances the counters. All blocks of one kind run in the same cycle, for the first time one period after the start.
void Clocks::advance(bool fast) {
  constexpr int64_t kPeriodsUs[] = {100'000, 1'000'000, 10'000'000, 100'000'000};
  constexpr int64_t kFastCycleUs = 1000;
  const int64_t cycleUs = fast ? kFastCycleUs : periodUs_;
  for (size_t i = 0; i < std::size(kPeriodsUs); ++i) {
    if (!used_[fast ? 1 : 0][i]) continue;
    const int64_t cycles = std::max<int64_t>(1, (kPeriodsUs[i] + cycleUs / 2) / cycleUs);
    const ir::SlotId counter = emitter_.newSlot(Type::I32, keyOf(fast, i));
    phases_.push_back(counter);
    state_.addTimer(counter);
    ir::RungBuilder& b = emitter_.b();
    const ValueId next = b.add(b.slotLoad(counter), b.i32(1));
    const ValueId due = b.leU(b.i32(static_cast<int32_t>(cycles)), next);
    b.slotStore(counter, b.select(due, b.i32(0), next));
    b.slotStore(dueSlot(fast, static_cast<TimedKind>(i)), due);
  }
  emitter_.out().cut();
}

ir::SlotId Clocks::dueSlot(bool fast, TimedKind kind) {
  ir::SlotId& slot = due_[{fast, kind}];
  if (!slot.valid()) slot = emitter_.newSlot(Type::Bit, keyOf(fast, static_cast<size_t>(kind)) + ".DUE");
  return slot;
}

ValueId Clocks::isDue(TimedKind kind, ModuleKind module, bool inProcedure) {
  ir::RungBuilder& b = emitter_.b();
  if (!inProcedure) return runsOnce(module) ? b.bit(false) : b.slotLoad(dueSlot(isFast(module), kind));
  const ValueId clock = b.slotLoad(clock_);
  const ValueId inMain = b.and_(b.eq(clock, b.i32(kMainClock)), b.slotLoad(dueSlot(false, kind)));
  const ValueId inFast = b.and_(b.eq(clock, b.i32(kFastClock)), b.slotLoad(dueSlot(true, kind)));
  return b.or_(inMain, inFast);
}

} // namespace rung::frontend::technol
