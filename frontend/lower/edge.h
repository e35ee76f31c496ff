// Edges: what a bit is now against what it was when the instruction ran last. The former value is in a slot of the
// instruction, or where the dialect's manual puts it.
#pragma once
#include "ir/core/builder.h"

namespace rung::frontend {

enum Edge : int { kRising, kFalling };

// Gives the slot a new value, and what it held before.
inline ir::ValueId exchange(ir::RungBuilder& b, ir::SlotId slot, ir::ValueId value) {
  const ir::ValueId before = b.slotLoad(slot);
  b.slotStore(slot, value);
  return before;
}

inline ir::ValueId edge(ir::RungBuilder& b, ir::ValueId before, ir::ValueId now, int which = kRising) {
  return which == kRising ? b.and_(now, b.not_(before)) : b.and_(before, b.not_(now));
}

// The edge since the last run of the instruction, which remembers the value.
inline ir::ValueId pulse(ir::RungBuilder& b, ir::SlotId slot, ir::ValueId now, int which = kRising) {
  return edge(b, exchange(b, slot, now), now, which);
}

} // namespace rung::frontend
