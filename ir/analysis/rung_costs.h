// Costs of rungs by their numbers, for paths (longest_path.h) to add up.
#pragma once
#include <cstdint>
#include <vector>

#include "ir/shape/partition.h"

namespace rung::ir {

// The steps that budgets count.
std::vector<uint64_t> rungWeights(const Partition& partition);
// The most executions of the operation in one run of each rung.
std::vector<uint64_t> mostOperations(const Partition& partition, OpCode operation);

} // namespace rung::ir
