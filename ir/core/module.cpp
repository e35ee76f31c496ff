// Look-ups by name in a module.
#include "ir/core/module.h"

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

} // namespace rung::ir
