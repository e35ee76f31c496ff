// Ends, jumps, calls and the common line (§7.1, §7.16-7.18).
#include "frontend/network/lower/lower_control.h"

namespace rung::frontend::network {

// JMPE, COME, LBL: places only.
void lowerMark(Lowering&) {}

// END1, END2 and SPE: back to the caller, and of a level there is none.
void lowerEnd(Lowering& f) { f.b.ret(); }

// JMP and JMPB.
void lowerJump(Lowering& f) { f.b.gotoRung(f.targetRung(), f.act()); }

// CALL has a condition, CALLU none.
void lowerCall(Lowering& f) {
  f.b.call(f.callee(), f.function.row->control == Control::Call ? f.act() : ir::ValueId{});
}

// JMPC: every caller on the way looks at the slot (P43).
void lowerLeave(Lowering& f) {
  f.b.when(f.act(), [&] { f.b.slotStore(f.leaveTarget(), f.b.i32(f.network.target + 1)); });
  f.b.ret(f.act());
}

void lowerCommonLine(Lowering& f) { f.b.slotStore(f.commonLine(), f.act()); }

} // namespace rung::frontend::network
