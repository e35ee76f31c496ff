// Procedures (man. ch. 3.17), and those that the control calls (man. l.1609).
#pragma once
#include "frontend/dialects/technol/lower/emitter.h"

namespace rung::frontend::technol {

class Procedures {
public:
  Procedures(const SourceProgram& program, Emitter& emitter);

  ir::RoutineId routine(uint32_t procedure) const { return routines_[procedure]; }
  // `depth`: values on the stack of the equation that contains the call; they are kept.
  void call(uint32_t procedure, uint32_t depth, ir::ValueId cond = {});
  // The number, i64, of a procedure among those that CAN_RECV_REQ names, in the order in which they are asked for.
  ir::ValueId event(uint32_t procedure);
  std::span<const uint32_t> events() const { return events_; }
  // Of messages, or kNone.
  uint32_t onMessage() const { return onMessage_; }
  // RLO, DR, DR_REAL and BX around a call that the program does not see.
  void saveRegisters();
  void restoreRegisters();

private:
  Emitter& emitter_;
  std::vector<ir::RoutineId> routines_;
  uint32_t onMessage_ = kNone;
  std::vector<uint32_t> events_;
  std::vector<ir::SlotId> saved_;
};

} // namespace rung::frontend::technol
