// A message of the program as operations give it to the control (see rtlib/nc/technol/services.h).
#pragma once

#include "frontend/dialects/technol/lower/memory.h"

namespace rung::frontend::technol {

struct MessageParts {
  ir::ValueId number; // i32
  ir::ValueId subId, par3;
  ir::ValueId pars; // par1 and above it par2
};

// par1 and par2, i32, as one.
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

} // namespace rung::frontend::technol
