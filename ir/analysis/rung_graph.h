// The control flow graph: one node per rung, and after them one for the exit of each routine. A call leads to the first
// rung of the callee, and the callee's exit to the rung below each of its calls, whichever call it was.
#pragma once
#include <span>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

class RungGraph {
public:
  explicit RungGraph(const Module& module);

  uint32_t nodeCount() const { return rungCount_ + static_cast<uint32_t>(firstNode_.size()); }
  uint32_t nodeOf(RoutineId routine, uint32_t rung) const { return firstNode_[routine.index] + rung; }
  std::span<const uint32_t> predecessors(uint32_t node) const {
    return {from_.data() + firstFrom_[node], from_.data() + firstFrom_[node + 1]};
  }

private:
  template <class Visit>
  void eachEdge(const Module& module, Visit visit) const;

  std::vector<uint32_t> firstNode_; // by routine
  uint32_t rungCount_ = 0;
  std::vector<uint32_t> firstFrom_; // by node, plus one entry: where its predecessors begin in `from_`
  std::vector<uint32_t> from_;
};

} // namespace rung::ir
