// Comparisons of two values of one type: integers with their signs, or floating-point numbers.
#pragma once
#include "ir/core/builder.h"

namespace rung::frontend {

enum Relation : int { kLess, kLessEqual, kEqual, kNotEqual, kGreaterEqual, kGreater };

// With a NaN only kNotEqual holds.
ir::ValueId compare(ir::RungBuilder& b, int relation, ir::ValueId x, ir::ValueId y);

} // namespace rung::frontend
