// Costs along ways, and of what budgets allow (see task_cost.h).
#include "tools/report/wcet_task_cost.h"

#include <algorithm>
#include <cmath>

#include "ir/support/saturate.h"

namespace rung::report {

TaskCost::TaskCost(const ir::Cut& cut, ir::TaskId task, const std::vector<std::vector<uint32_t>>& circles)
    : cut_(cut), task_(task), hasCircles_(!circles.empty()), inCircle_(cut.rungCount(), false),
      uses_(cut.module().routines.size(), Use::None) {
  for (const std::vector<uint32_t>& circle : circles)
    for (const uint32_t rung : circle) inCircle_[rung] = true;
  const ir::RoutineId entry = cut.module().tasks[task.index].entry;
  uses_[entry.index] = Use::Once;
  std::vector<ir::RoutineId> open{entry};
  while (!open.empty()) {
    const ir::RoutineId routine = open.back();
    open.pop_back();
    forCalls(routine, [&](uint32_t rung, ir::RoutineId callee) {
      const bool again = uses_[routine.index] == Use::Again || inCircle_[rung];
      const Use use = again ? Use::Again : Use::Once;
      if (use <= uses_[callee.index]) return;
      uses_[callee.index] = use;
      open.push_back(callee);
    });
  }
}

// A way without circles is known; what circles may run again is bounded by the budget that ends them, and the rest by
// all that there is of it, each chunk once: in which order they come is not known.
uint64_t TaskCost::most(std::span<const uint64_t> costs) const {
  if (!hasCircles_) return std::min(ir::heaviestWay(cut_, task_, costs).cost, allowed(costs, false));
  return std::min(saturatedSum(outsideOfCircles(costs), allowed(costs, true)), allowed(costs, false));
}

// Of a run that takes whatever way: a chunk takes its weight from the budget, and no more of the cost for that than the
// dearest one.
uint64_t TaskCost::allowed(std::span<const uint64_t> costs, bool repeatedOnly) const {
  double dearest = 0;
  for (const ir::Chunk& chunk : cut_.chunks())
    if (reaches(chunk) && (isRepeated(chunk) || !repeatedOnly))
      dearest = std::max(dearest, static_cast<double>(costOf(chunk, costs)) / chunk.weight);
  const double most = std::ceil(dearest * cut_.module().tasks[task_.index].budget);
  return most >= static_cast<double>(UINT64_MAX) ? UINT64_MAX : static_cast<uint64_t>(most);
}

uint64_t TaskCost::outsideOfCircles(std::span<const uint64_t> costs) const {
  std::vector<std::optional<uint64_t>> runs(uses_.size());
  uint64_t all = 0;
  for (const ir::Chunk& chunk : cut_.chunks())
    if (reaches(chunk) && !isRepeated(chunk))
      all = saturatedSum(all, saturatedProduct(runsOf(chunk.routine, runs), costOf(chunk, costs)));
  return all;
}

// At most, of a routine that no circle calls; `known`: of others. Calls are nested no deeper than the stack of
// rung_ctx.
uint64_t TaskCost::runsOf(ir::RoutineId routine, std::vector<std::optional<uint64_t>>& known) const {
  if (const std::optional<uint64_t>& runs = known[routine.index]) return *runs;
  uint64_t runs = routine == cut_.module().tasks[task_.index].entry ? 1 : 0;
  for (uint32_t caller = 0; caller < uses_.size(); ++caller)
    if (uses_[caller] == Use::Once)
      forCalls(ir::RoutineId{caller}, [&](uint32_t, ir::RoutineId callee) {
        if (callee == routine) runs = saturatedSum(runs, runsOf(ir::RoutineId{caller}, known));
      });
  known[routine.index] = runs;
  return runs;
}

bool TaskCost::isRepeated(const ir::Chunk& chunk) const {
  if (uses_[chunk.routine.index] == Use::Again) return true;
  for (uint32_t i = 0; i < chunk.rungCount; ++i)
    if (inCircle_[cut_.rungNumber(chunk.routine, chunk.firstRung + i)]) return true;
  return false;
}

uint64_t TaskCost::costOf(const ir::Chunk& chunk, std::span<const uint64_t> costs) const {
  uint64_t cost = 0;
  for (uint32_t i = 0; i < chunk.rungCount; ++i)
    cost = saturatedSum(cost, costs[cut_.rungNumber(chunk.routine, chunk.firstRung + i)]);
  return cost;
}

template <class Visit>
void TaskCost::forCalls(ir::RoutineId routine, Visit visit) const {
  const std::vector<ir::Rung>& rungs = cut_.module().at(routine).rungs;
  for (uint32_t i = 0; i < rungs.size(); ++i)
    if (rungs[i].transfer.kind == ir::TransferKind::Call) visit(cut_.rungNumber(routine, i), rungs[i].transfer.callee);
}

} // namespace rung::report
