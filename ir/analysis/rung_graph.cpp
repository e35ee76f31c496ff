// Builds the control flow graph (see rung_graph.h).
#include "ir/analysis/rung_graph.h"

namespace rung::ir {

// Calls visit(from, to).
template <class Visit>
void RungGraph::eachEdge(const Module& module, Visit visit) const {
  for (uint32_t r = 0; r < module.routines.size(); ++r) {
    const std::vector<Rung>& rungs = module.routines[r].rungs;
    const uint32_t wayOut = rungCount_ + r;
    for (uint32_t i = 0; i < rungs.size(); ++i) {
      const Transfer& transfer = rungs[i].transfer;
      const uint32_t node = firstNode_[r] + i;
      const uint32_t below = i + 1 < rungs.size() ? node + 1 : wayOut;
      if (transfer.cond.valid() || transfer.kind == TransferKind::Next) visit(node, below);
      switch (transfer.kind) {
      case TransferKind::Goto: visit(node, firstNode_[r] + transfer.target); break;
      case TransferKind::Call:
        visit(node, firstNode_[transfer.callee.index]);
        visit(rungCount_ + transfer.callee.index, below);
        break;
      case TransferKind::Ret: visit(node, wayOut); break;
      case TransferKind::Switch:
        for (uint32_t target : transfer.targets) visit(node, firstNode_[r] + target);
        break;
      case TransferKind::Next:
      case TransferKind::End: break;
      }
    }
  }
}

RungGraph::RungGraph(const Module& module) {
  for (const Routine& routine : module.routines) {
    firstNode_.push_back(rungCount_);
    rungCount_ += static_cast<uint32_t>(routine.rungs.size());
  }
  firstFrom_.assign(nodeCount() + 1, 0);
  eachEdge(module, [&](uint32_t, uint32_t to) { ++firstFrom_[to + 1]; });
  for (uint32_t i = 0; i < nodeCount(); ++i) firstFrom_[i + 1] += firstFrom_[i];
  from_.resize(firstFrom_.back());
  std::vector<uint32_t> next(firstFrom_.begin(), firstFrom_.end() - 1);
  eachEdge(module, [&](uint32_t from, uint32_t to) { from_[next[to]++] = from; });
}

} // namespace rung::ir
