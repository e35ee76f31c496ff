// Derives the properties of a chunk's rungs and exits (see chunk_plan.h).
#include "codegen/plan/chunk_plan.h"

#include <algorithm>

#include "ir/core/op_info.h"

namespace rung::codegen {
namespace {

using namespace ir;

template <class Visit>
void forDestinations(const Exit& exit, Visit visit) {
  visit(exit.taken);
  visit(exit.otherwise);
  for (const Destination& to : exit.targets) visit(to);
}

bool hostReadsDuring(const Rung& rung) {
  return std::ranges::any_of(rung.ops, [](const Op& op) { return hostReads(opInfo(op.code)); });
}

} // namespace

ChunkPlan planOf(const Layout& layout, uint32_t number) {
  const Chunk& chunk = layout.partition().chunks()[number];
  const Routine& routine = layout.module().at(chunk.routine);
  ChunkPlan plan{.chunk = chunk, .routine = routine, .exits = {}, .isTarget = std::vector<bool>(chunk.rungCount)};
  for (uint32_t i = chunk.firstRung; i < plan.endRung(); ++i) {
    const Exit& exit = plan.exits.emplace_back(exitOf(layout.partition(), chunk.routine, i));
    forDestinations(exit, [&](const Destination& to) { plan.addsWeight = plan.addsWeight || to.extra != 0; });
    const auto jumpsTo = [&](const Destination& to) {
      if (to.inside()) plan.isTarget[to.rung - chunk.firstRung] = true;
    };
    jumpsTo(exit.taken);
    for (const Destination& to : exit.targets) jumpsTo(to);
    plan.hostReads = plan.hostReads || hostReadsDuring(routine.rungs[i]);
  }
  return plan;
}

} // namespace rung::codegen
