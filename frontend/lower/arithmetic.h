// Instructions that compute a value of two of one type: the variants of their rows, and the operations.
#pragma once
#include "ir/core/builder.h"

namespace rung::frontend {

enum Arithmetic : int { kAdd, kSubtract, kMultiply, kDivide };
enum Logic : int { kAnd, kOr, kXor };

// Of integers with their signs, modulo their width, or of floating-point numbers.
ir::ValueId compute(ir::RungBuilder& b, int arithmetic, ir::ValueId x, ir::ValueId y);
// Of bits, or of integers bit by bit.
ir::ValueId combine(ir::RungBuilder& b, int logic, ir::ValueId x, ir::ValueId y);

} // namespace rung::frontend
