// Procedures (man. ch. 3.17), including those that the control calls (man. l.1609).
#pragma once
#include "frontend/dialects/technol/lower/emitter.h"

namespace rung::frontend::technol {

class Procedures {
public:
  Procedures(const SourceProgram& program, Emitter& emitter);

  ir::RoutineId routine(uint32_t procedure) const { return routines_[procedure]; }
  // `depth`: number of values on the stack of the equation that contains the call; they are saved.
  void call(uint32_t procedure, uint32_t depth, ir::ValueId cond = {});
  // The number, i64, of a procedure among those that CAN_RECV_REQ names, in the order of first use.
  ir::ValueId event(uint32_t procedure);
  std::span<const uint32_t> events() const { return events_; }
  // The procedure of messages, or kNone.
  uint32_t onMessage() const { return onMessage_; }
  // Save and restore RLO, DR, DR_REAL and BX around a call that is not visible in the program.
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
