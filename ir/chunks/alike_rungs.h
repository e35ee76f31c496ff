// Rungs that do the same at other places, as programs have them for alarms, pockets and lamps: a compiler can do
// several of them at once.
#pragma once
#include "ir/chunks/cut.h"

namespace rung::ir {

// Whether a row of the chunk's rungs has, rung by rung or group of rungs by group, the same operations but for their
// places and numbers, and is long enough to be worth looking at.
bool hasAlikeRungs(const Module& module, const Chunk& chunk);

} // namespace rung::ir
