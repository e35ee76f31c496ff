// The context of a row's lowering function: conditions as values, checked parameters, and operations that several
// functions use. The function determines the output bit W; coils are lowered separately.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "frontend/network/lower/lowered_row.h"
#include "frontend/network/program.h"
#include "ir/core/builder.h"
#include "rtlib/nc/service.h"

namespace rung::frontend::network {

class ModuleLowering;
struct LevelState;
struct RoutineContext;

inline Address plus(Address address, uint32_t bytes) {
  address.byte += bytes;
  return address;
}
// Whether a number is in a set of bits by their numbers; one above 63 never is.
ir::ValueId isIn(ir::RungBuilder& b, ir::ValueId number, uint64_t set);

class Lowering {
public:
  Lowering(ModuleLowering& module, RoutineContext& routine, ir::RungBuilder& builder, const Network& network,
           std::span<const ir::ValueId> conditions, std::string_view slotPrefix);

  ir::RungBuilder& b;
  const Network& network;
  const Function& function;

  int variant() const { return loweredRow(*function.row).variant; }
  const Param& param(size_t i) const { return function.params[i]; }
  ir::ValueId condition(size_t i) const { return conditions_[i]; }
  // Its value if it never changes.
  std::optional<bool> constantOf(size_t condition) const;
  ir::ValueId act() const { return conditions_.back(); }
  // The integer type with the number of bytes of the format.
  ir::Type dataType() const { return ir::intOfBytes(function.length); }

  ir::ValueId load(ir::Type type, const Address& address);
  void store(const Address& address, ir::ValueId value);
  // `legal` of the `bytes` from `address` may be the first of an element.
  ir::Window window(const Address& address, uint32_t bytes, uint32_t legal) const;
  const Language& language() const;
  // A byte of the result registers, of which each level has a set of its own (P4).
  Address result(uint32_t offset) const;
  // The number of bytes from an address to the end of its area.
  uint32_t room(const Address& address) const;
  // A parameter that is an address or a constant.
  ir::ValueId operand(size_t i, ir::Type type);

  // State of this instruction; all calls with the same role return the same slot, also on the other level.
  ir::SlotId slot(std::string_view role, ir::Type type, int64_t init = 0);
  // A word as the cell of a timer.
  ir::TimerCell wordCell(const Address& address) const;
  // This instruction as a timer, for displays. An instruction that several levels run is one timer.
  void addTimer(ir::Timer timer);
  // Microseconds between the beginnings of this and the last run of the level.
  ir::ValueId scanTime();
  // Whether every run of the level executes this network exactly once.
  bool onceEachRun() const;
  // Microseconds since the last run of the level began.
  ir::ValueId sinceLastRun();
  // State that all instructions of the program share.
  ir::SlotId shared(const std::string& key, ir::Type type);
  // markRun records the current run of each level; runsSinceMark is the number of runs since then, on this level
  // (signed).
  void markRun();
  ir::ValueId runsSinceMark();
  ir::ServiceId service(const nc::ServiceRow& row);
  // A space that the host accesses by its name; `legal` of its bytes may be the first of an element.
  ir::Window hidden(const std::string& name, uint32_t bytes, uint32_t legal);
  // Constant bytes in a hidden space; `legal` of them may be the first of an element.
  ir::Window constants(std::string_view bytes, uint32_t legal);

  void setOutput(ir::ValueId w) { output_ = w; }
  ir::ValueId output() const { return output_; }
  // The latched output of §6.3: with `execute` W is the result of `body`, otherwise it keeps its value; `reset` (may be
  // invalid) makes it 0 and takes precedence (P15, P17).
  void latchedOutput(ir::ValueId execute, ir::ValueId reset, const std::function<ir::ValueId()>& body);
  // W after the last scan, for a `body` that changes nothing.
  ir::ValueId oldOutput();
  // The usual handling of RST and ACT, the last two conditions of most functions.
  void resettable(const std::function<ir::ValueId()>& body);

  // Control: rungs and routines of this level.
  uint32_t targetRung() const;
  ir::RoutineId callee() const;
  // The result of COM, for the networks up to COME.
  ir::SlotId commonLine();
  // The target of a pending JMPC, plus 1; 0: none is pending.
  ir::SlotId leaveTarget();

private:
  ir::SlotId runMark(const LevelState& level);

  ModuleLowering& module_;
  RoutineContext& routine_;
  std::span<const ir::ValueId> conditions_;
  std::string_view slotPrefix_;
  ir::ValueId output_{};
};

// Lowering of the instructions that shape the program.

void lowerMark(Lowering& f);
void lowerEnd(Lowering& f);
void lowerJump(Lowering& f);
void lowerCall(Lowering& f);
void lowerLeave(Lowering& f);
void lowerCommonLine(Lowering& f);

} // namespace rung::frontend::network
