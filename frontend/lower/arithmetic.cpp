// Arithmetic and logic (see arithmetic.h).
#include "frontend/lower/arithmetic.h"

#include "ir/core/ops.h"

namespace rung::frontend {

using ir::OpCode;

ir::ValueId compute(ir::RungBuilder& b, int arithmetic, ir::ValueId x, ir::ValueId y) {
  constexpr OpCode kIntegers[] = {OpCode::Add, OpCode::Sub, OpCode::Mul, OpCode::DivS};
  constexpr OpCode kReals[] = {OpCode::FAdd, OpCode::FSub, OpCode::FMul, OpCode::FDiv};
  return b.binary((b.typeOf(x) == ir::Type::F64 ? kReals : kIntegers)[arithmetic], x, y);
}

ir::ValueId combine(ir::RungBuilder& b, int logic, ir::ValueId x, ir::ValueId y) {
  constexpr OpCode kCodes[] = {OpCode::And, OpCode::Or, OpCode::Xor};
  return b.binary(kCodes[logic], x, y);
}

} // namespace rung::frontend
