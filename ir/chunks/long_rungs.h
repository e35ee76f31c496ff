// Compilers take a time that grows with the square of the length of a chain of operations: a line of 10,000 contacts
// took LLVM 25 s. In a rung that long some values go through memory, where a chain ends for whatever looks along it.
#pragma once
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

// By value, whether it goes through memory. Empty: none, as in all rungs of a usual length.
std::vector<bool> valuesThroughMemory(const Rung& rung);

} // namespace rung::ir
