// The code of an operation as an incomplete enumeration, for files that only pass codes on: they are not recompiled for
// a new operation. A file that names operations includes ops.h.
#pragma once
#include <cstdint>

namespace rung::ir {

enum class OpCode : uint8_t; // enumerators from ops.def

// How often the condition of an if is 1 when it is reached. Only the layout of the code depends on it.
enum BranchWeights : uint8_t {
  kEven = 0, // unknown
  kMostly = 1,
  kSeldom = 2,
};

} // namespace rung::ir
