// Timed blocks and the clocks that they go by (man. l.857-882): one of the 20 ms task, one of the fast task.
#include "frontend/dialects/technol/lower/lowering.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

// What the slot CLOCK holds while a module runs; a procedure goes by the clock of its caller.
enum : int32_t { kMainClock = 0, kFastClock = 1, kNoClock = 2 };

bool isFast(ModuleKind kind) {
  return kind == ModuleKind::Fast || kind == ModuleKind::Fastest || kind == ModuleKind::Cyclic;
}

// Modules outside the cycle: no period has passed when they run.
bool runsOnce(ModuleKind kind) {
  return kind == ModuleKind::Init || kind == ModuleKind::Done || kind == ModuleKind::Clear || kind == ModuleKind::Halt;
}

} // namespace

void Lowering::findTimed() {
  for (const Unit& unit : program_.units) {
    if (unit.kind != UnitKind::Timed) continue;
    const Unit* around = &unit; // the module or procedure that it is in
    while (around->kind != UnitKind::Procedure && around->parent != kNone) around = &program_.units[around->parent];
    const bool inProcedure = around->kind == UnitKind::Procedure;
    if (inProcedure && !clock_.valid()) {
      module_.slots.push_back({.type = Type::I32, .key = "CLOCK"});
      clock_ = {static_cast<uint32_t>(module_.slots.size()) - 1};
    }
    const Row* row = findRow(unit.name);
    for (const bool fast : {false, true})
      if (inProcedure || (!runsOnce(around->module) && isFast(around->module) == fast))
        timedUsed_[fast ? 1 : 0][static_cast<size_t>(row->variant)] = true;
  }
}

// The module that runs first in each millisecond moves the fast clock on.
ModuleKind Lowering::firstFast() const {
  for (const ModuleKind kind : {ModuleKind::Cyclic, ModuleKind::Fastest})
    for (const ModulePart& part : program_.parts)
      if (part.kind == kind) return kind;
  return ModuleKind::Fast;
}

// In front of a module: its clock, and the time that has passed.
void Lowering::enterClock(ModuleKind kind) {
  if (clock_.valid() && (isFast(kind) || runsOnce(kind))) setClock(isFast(kind) ? kFastClock : kNoClock);
  if (kind == ModuleKind::Input) advanceClock(false);
  if (kind == firstFast()) advanceClock(true);
}

void Lowering::leaveClock(ModuleKind kind) {
  if (clock_.valid() && (isFast(kind) || runsOnce(kind))) setClock(kMainClock);
}

void Lowering::setClock(int32_t clock) {
  out_->cut();
  b().slotStore(clock_, b().i32(clock));
  out_->cut();
}

// An event comes between two cycles.
void Lowering::callEvent(ir::RoutineId procedure) {
  const bool timed = clock_.valid();
  if (timed) b().slotStore(clock_, b().i32(kNoClock));
  out_->call(procedure);
  if (timed) setClock(kMainClock);
}

// All blocks of one kind run in the same cycle, first one period after the start.
void Lowering::advanceClock(bool fast) {
  constexpr int64_t kPeriodsUs[] = {100'000, 1'000'000, 10'000'000, 100'000'000};
  constexpr int64_t kFastCycleUs = 1000;
  const int64_t cycleUs = fast ? kFastCycleUs : periodUs_;
  const std::array<bool, 4>& used = timedUsed_[fast ? 1 : 0];
  for (size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    const int64_t cycles = std::max<int64_t>(1, (kPeriodsUs[i] + cycleUs / 2) / cycleUs);
    module_.slots.push_back(
        {.type = Type::I32, .key = std::string(fast ? "FAST" : "MAIN") + ".DFTM" + std::to_string(i)});
    const ir::SlotId counter{static_cast<uint32_t>(module_.slots.size()) - 1};
    phases_.push_back(counter);
    timers_.push_back(counter);
    ir::RungBuilder& b = out_->b();
    const ValueId next = b.add(b.slotLoad(counter), b.i32(1));
    const ValueId due = b.leU(b.i32(static_cast<int32_t>(cycles)), next);
    b.slotStore(counter, b.select(due, b.i32(0), next));
    b.slotStore(dueSlot(fast, static_cast<TimedKind>(i)), due);
  }
  out_->cut();
}

ir::SlotId Lowering::dueSlot(bool fast, TimedKind kind) {
  const auto [entry, isNew] =
      due_.emplace(std::pair(fast, kind), ir::SlotId{static_cast<uint32_t>(module_.slots.size())});
  if (isNew)
    module_.slots.push_back(
        {.type = Type::Bit,
         .key = std::string(fast ? "FAST" : "MAIN") + ".DFTM" + std::to_string(static_cast<int>(kind)) + ".DUE"});
  return entry->second;
}

ValueId Lowering::isDue(TimedKind kind) {
  if (procedure_ == kNone) return runsOnce(kind_) ? b().bit(false) : b().slotLoad(dueSlot(isFast(kind_), kind));
  const ValueId clock = b().slotLoad(clock_);
  const ValueId inMain = b().and_(b().eq(clock, b().i32(kMainClock)), b().slotLoad(dueSlot(false, kind)));
  const ValueId inFast = b().and_(b().eq(clock, b().i32(kFastClock)), b().slotLoad(dueSlot(true, kind)));
  return b().or_(inMain, inFast);
}

void Lowering::beginTimed() {
  const uint32_t end = jumpTarget(typedProgram_.operandsOf(*typed_)[0]);
  out_->cut();
  out_->statement(sourceOf(*statement_));
  out_->jump(end, b().not_(isDue(static_cast<TimedKind>(statement_->row->variant))));
}

} // namespace rung::frontend::technol
