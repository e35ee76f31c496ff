// The code of an operation, for those who hand it on: a new operation then does not compile them again. A file that
// names operations includes ops.h.
#pragma once
#include <cstdint>

namespace rung::ir {

enum class OpCode : uint8_t; // those of ops.def

// How often the condition of an if is 1 where it is reached. Only the order of the code depends on it.
enum BranchWeights : uint8_t {
  kEven = 0, // nothing is known
  kMostly = 1,
  kSeldom = 2,
};

} // namespace rung::ir
