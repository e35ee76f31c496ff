// Messages: their parts, and bits that trigger them.
#pragma once
#include <array>
#include <span>

#include "frontend/dialects/technol/lower/memory.h"

namespace rung::frontend::technol {

// A message of the program, as operations pass it to the control.

struct MessageParts {
  ir::ValueId number; // i32
  ir::ValueId subId, par3;
  ir::ValueId pars; // par1 in the low word, par2 in the high one
};

// par1 and par2, i32, as one value.
inline ir::ValueId bothPars(ir::RungBuilder& b, ir::ValueId par1, ir::ValueId par2) {
  const ir::ValueId wide = b.zextOrTrunc(ir::Type::I64, par2);
  const ir::ValueId high = b.shl(wide, b.i32(32));
  return b.or_(b.zextOrTrunc(ir::Type::I64, par1), high);
}

inline void send(ir::RungBuilder& b, const MessageParts& m, uint32_t op, uint32_t marks) {
  b.message(op, b.or_(m.number, b.i32(static_cast<int32_t>(marks))), m.par3, m.subId, m.pars);
}

inline ir::ValueId valueOr0(Memory& memory, const Operand& operand, ir::Type type) {
  ir::RungBuilder& b = memory.emitter().b();
  return operand.given() ? b.zextOrTrunc(type, memory.value(operand)) : b.constant(type, 0);
}

// Bits that trigger messages, as connected by EDEF (man. ch. 14.3).

// A bit that triggers a message. Each execution of the statement with another number or index is an entry in the hidden
// space @EDEF, which CLEAR does not clear.
struct BitMessage {
  const Statement* statement = nullptr;
  std::span<const Operand> pars;
  std::array<MemoryAccess, 4> places; // of the bit and of pars
  uint32_t mode = 0;
  uint32_t capacity = 1;
  uint32_t table = 0; // first byte in @EDEF: the number of entries, followed by these
};

class BitMessages {
public:
  BitMessages(const SourceProgram& program, Memory& memory, State& state)
      : program_(program), memory_(memory), emitter_(memory.emitter()), state_(state) {}

  // Connects the bit when the statement is executed, with the present values of `number` and `subId`, i32.
  void add(BitMessage message, ir::ValueId number, ir::ValueId subId);
  // Disconnects all bits; called at each start.
  void forget();
  // The routine that checks all bits, and its weight; invalid if there are none.
  ir::RoutineId makeTask(uint64_t& weight);

private:
  void reserve(BitMessage& message);

  const SourceProgram& program_;
  Memory& memory_;
  Emitter& emitter_;
  State& state_;
  std::vector<BitMessage> messages_;
  ir::SpaceId space_;
};

} // namespace rung::frontend::technol
