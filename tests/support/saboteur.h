// Proof that a comparison of engines is worth something: a module in which one operation does something else is taken
// for an emitter that is wrong for this operation. Emitters know nothing of it.
#pragma once
#include "ir/core/module.h"

namespace rung::ir {

// Makes every operation with this code wrong, all but `note`, which does nothing: it gives or uses another value, or is
// done once more or once less. The module keeps its memory, its rungs and the paths out of them, so that the layout of
// the right one serves (Layout::over).
void sabotage(Module& module, OpCode code);

} // namespace rung::ir
