// What rungs cost, by their numbers: what paths (longest_path.h) add up.
#pragma once
#include <cstdint>
#include <vector>

#include "ir/shape/partition.h"

namespace rung::ir {

// The steps that budgets count.
std::vector<uint64_t> rungWeights(const Partition& partition);
// How often a run of the rung does the operation at most.
std::vector<uint64_t> mostOperations(const Partition& partition, OpCode operation);

} // namespace rung::ir
