// Timed blocks and their clocks (man. l.857-882): one of the 20 ms task, one of the fast task.
#pragma once

#include <array>
#include <map>

#include "frontend/dialects/technol/lower/memory.h"

namespace rung::frontend::technol {

class Clocks {
public:
  Clocks(const SourceProgram& program, Emitter& emitter, State& state, uint32_t periodUs);

  // Called at the beginning and end of a module: advance its clock, and the time that has passed.
  void enter(ModuleKind kind);
  void leave(ModuleKind kind);
  // Events are called between two cycles.
  void callEvent(ir::RoutineId procedure);
  // Whether a timed block runs, in a module or in a procedure.
  ir::ValueId isDue(TimedKind kind, ModuleKind module, bool inProcedure);
  // Number of cycles of each period that have passed.
  std::span<const ir::SlotId> phases() const { return phases_; }

private:
  void find(const Unit& timed);
  ModuleKind firstFast() const;
  void set(int32_t clock);
  void advance(bool fast);
  ir::SlotId dueSlot(bool fast, TimedKind kind);

  const SourceProgram& program_;
  Emitter& emitter_;
  State& state_;
  uint32_t periodUs_;
  std::array<std::array<bool, 4>, 2> used_{}; // by task (20 ms, fast) and by TimedKind
  std::map<std::pair<bool, TimedKind>, ir::SlotId> due_;
  std::vector<ir::SlotId> phases_;
  ir::SlotId clock_; // of the running module, if procedures have timed blocks
};

} // namespace rung::frontend::technol
