// Arithmetic, logic, comparisons.
#include "frontend/lower/operations.h"

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

// Comparisons.

using ir::OpCode;

ir::ValueId compare(ir::RungBuilder& b, int relation, ir::ValueId x, ir::ValueId y) {
  const bool real = b.typeOf(x) == ir::Type::F64;
  const OpCode less = real ? OpCode::FLt : OpCode::LtS;
  const OpCode atMost = real ? OpCode::FLe : OpCode::LeS;
  switch (static_cast<Relation>(relation)) {
  case kLess: return b.binary(less, x, y);
  case kLessEqual: return b.binary(atMost, x, y);
  case kEqual: return b.binary(real ? OpCode::FEq : OpCode::Eq, x, y);
  case kNotEqual: return real ? b.not_(b.fEq(x, y)) : b.ne(x, y);
  case kGreaterEqual: return b.binary(atMost, y, x);
  case kGreater: return b.binary(less, y, x);
  }
  return {};
}

} // namespace rung::frontend
