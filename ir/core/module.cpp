// Look-ups in a module.
#include "ir/core/module.h"

#include <algorithm>

namespace rung::ir {
namespace {

template <class IdType, class Vector>
IdType findByName(const Vector& items, std::string_view name) {
  for (uint32_t i = 0; i < items.size(); ++i)
    if (items[i].name == name) return IdType{i};
  return {};
}

} // namespace

SpaceId findSpace(const Module& module, std::string_view name) { return findByName<SpaceId>(module.spaces, name); }
RoutineId findRoutine(const Module& module, std::string_view name) {
  return findByName<RoutineId>(module.routines, name);
}
TaskId findTask(const Module& module, std::string_view name) { return findByName<TaskId>(module.tasks, name); }

std::vector<const Symbol*> placedSymbols(const Module& module) {
  std::vector<const Symbol*> placed;
  for (const Symbol& symbol : module.symbols)
    if ((symbol.flags & RUNG_SYMBOL_CONST) == 0) placed.push_back(&symbol);
  std::ranges::stable_partition(placed, [](const Symbol* s) { return (s->flags & RUNG_SYMBOL_HIDDEN) == 0; });
  return placed;
}

std::vector<RoutineId> routinesFrom(const Module& module, RoutineId entry) {
  std::vector<bool> seen(module.routines.size(), false);
  std::vector<RoutineId> reached{entry};
  seen[entry.index] = true;
  for (size_t i = 0; i < reached.size(); ++i)
    for (const Rung& rung : module.at(reached[i]).rungs) {
      const RoutineId callee = rung.transfer.callee;
      if (rung.transfer.kind != TransferKind::Call || seen[callee.index]) continue;
      seen[callee.index] = true;
      reached.push_back(callee);
    }
  return reached;
}

} // namespace rung::ir
