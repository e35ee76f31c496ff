// Computes branch weights of ifs from counts (see branch_weights.h).
#include "ir/analysis/branch_weights.h"

#include <algorithm>

#include "ir/core/ops.h"

namespace rung::ir {
namespace {

constexpr uint64_t kRare = 10; // seldom: at most one in this many

BranchWeights weightsOf(const Branch& branch) {
  if (branch.taken <= branch.reached / kRare) return kSeldom; // also if it was never reached
  return branch.reached - branch.taken <= branch.reached / kRare ? kMostly : kEven;
}

bool isIf(const Op& op) { return op.code == OpCode::If; }

} // namespace

BranchWeightsResult setBranchWeights(Module& module, const BranchCounts& counts) {
  BranchWeightsResult result;
  for (Routine& routine : module.routines)
    for (Rung& rung : routine.rungs) {
      const auto ifs = static_cast<size_t>(std::ranges::count_if(rung.ops, isIf));
      if (ifs == 0 || rung.key == 0) continue;
      const auto found = counts.find(rung.key);
      const bool same = found != counts.end() && found->second.size() == ifs;
      ++(same ? result.known : result.unknown);
      if (!same) continue;
      auto branch = found->second.begin();
      for (Op& op : rung.ops)
        if (isIf(op)) op.ref = weightsOf(*branch++);
    }
  return result;
}

} // namespace rung::ir
