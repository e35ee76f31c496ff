// Bits that make messages, as EDEF ties them (man. ch. 14.3).
#pragma once

#include <array>
#include <span>

#include "frontend/dialects/technol/lower/state.h"

namespace rung::frontend::technol {

// A bit that makes a message. Each execution of the statement that differs in number or index is an entry in the hidden
// space @EDEF, which outlives CLEAR.
struct BitMessage {
  const Statement* statement = nullptr;
  std::span<const Operand> pars;
  std::array<MemoryAccess, 4> places; // of the bit and of pars
  uint32_t mode = 0;
  uint32_t capacity = 1;
  uint32_t table = 0; // first byte in @EDEF: the number of entries, then these
};

class BitMessages {
public:
  BitMessages(const SourceProgram& program, Memory& memory, State& state)
      : program_(program), memory_(memory), emitter_(memory.emitter()), state_(state) {}

  // Ties the bit, where a statement is carried out; `number` and `subId`, i32, are taken then.
  void add(BitMessage message, ir::ValueId number, ir::ValueId subId);
  // At each start the bits are tied anew.
  void forget();
  // The routine that looks at all bits, and its weight; invalid where there are none.
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
