// Computes costs of rungs (see rung_costs.h).
#include "ir/analysis/rung_costs.h"

#include <algorithm>

#include "ir/core/ops.h"
#include "ir/support/saturate.h"

namespace rung::ir {
namespace {

template <class CostOf>
std::vector<uint64_t> byNumber(const Partition& partition, CostOf costOf) {
  std::vector<uint64_t> costs(partition.rungCount());
  const std::vector<Routine>& routines = partition.module().routines;
  for (uint32_t r = 0; r < routines.size(); ++r)
    for (uint32_t i = 0; i < routines[r].rungs.size(); ++i)
      costs[partition.rungNumber(RoutineId{r}, i)] = costOf(routines[r].rungs[i]);
  return costs;
}

// The number of operations in a region so far.
struct Region {
  uint64_t count = 0;
  uint64_t first = 0;  // of an if: number in the branch before its else
  uint64_t rounds = 1; // of a loop: its iterations
};

uint64_t mostIn(const Rung& rung, OpCode operation) {
  std::vector<Region> open(1);
  for (const Op& op : rung.ops) {
    if (op.code == operation) open.back().count = saturatedSum(open.back().count, 1);
    if (op.code == OpCode::If) open.emplace_back();
    if (op.code == OpCode::Loop) open.push_back({.rounds = op.count});
    if (op.code == OpCode::Else) open.back() = {.first = open.back().count};
    if (op.code != OpCode::EndIf && op.code != OpCode::EndLoop) continue;
    const Region closed = open.back();
    open.pop_back();
    const uint64_t most = saturatedProduct(std::max(closed.first, closed.count), closed.rounds);
    open.back().count = saturatedSum(open.back().count, most);
  }
  return open.back().count;
}

} // namespace

std::vector<uint64_t> rungWeights(const Partition& partition) {
  return byNumber(partition, [](const Rung& rung) { return std::max(1u, rung.weight); });
}

std::vector<uint64_t> mostOperations(const Partition& partition, OpCode operation) {
  return byNumber(partition, [operation](const Rung& rung) { return mostIn(rung, operation); });
}

} // namespace rung::ir
