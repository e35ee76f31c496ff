// What rungs cost, by their numbers: what ways (heaviest.h) add up.
#pragma once
#include <cstdint>
#include <vector>

#include "ir/shape/cut.h"

namespace rung::ir {

// The steps that budgets count.
std::vector<uint64_t> rungWeights(const Cut& cut);
// How often a run of the rung does the operation at most.
std::vector<uint64_t> mostOperations(const Cut& cut, OpCode operation);

} // namespace rung::ir
