// Typed indices of the IR: what refers to what. An id is an index into one vector of its owner, never a pointer.
#pragma once
#include "ir/support/ids.h"

namespace rung::ir {

using SpaceId = Id<struct SpaceTag>;     // in Module::spaces
using SlotId = Id<struct SlotTag>;       // in Module::slots
using RoutineId = Id<struct RoutineTag>; // in Module::routines
using TaskId = Id<struct TaskTag>;       // in Module::tasks
using FaultId = Id<struct FaultTag>;     // in Module::faults
using ServiceId = Id<struct ServiceTag>; // in Module::services
using ValueId = Id<struct ValueTag>;     // in Rung::values; never crosses a rung
using FileIndex = Id<struct PathTag>;    // in Module::files

} // namespace rung::ir
