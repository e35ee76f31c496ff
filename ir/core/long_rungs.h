// Compilers take a time that grows with the square of the length of a chain of operations: a line of 10,000 contacts
// took LLVM 25 s. A rung that long is dealt with in stretches: what a chain has computed goes through memory from one
// to the next, where it ends for whatever looks along it, and all else is computed in each stretch.
#pragma once
#include <cstddef>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

inline constexpr size_t kStretch = 256; // operations

inline bool isLong(const Rung& rung) { return rung.ops.size() >= 16 * kStretch; }

// By value, whether it goes through memory. Empty: none, as in all rungs of a usual length.
std::vector<bool> valuesThroughMemory(const Rung& rung);

} // namespace rung::ir
