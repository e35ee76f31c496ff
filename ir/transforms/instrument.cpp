// Profiling: each rung is measured from its first operation to its last. Conditions of the transfer are values of the
// rung and thus included; a callee's work is not.
#include "ir/core/ops.h"
#include "ir/transforms/passes.h"

namespace rung::ir {

void instrumentRungs(Module& module) {
  if (module.instrumented) return;
  Op enter;
  enter.code = OpCode::ProfEnter;
  Op leave;
  leave.code = OpCode::ProfLeave;
  for (Routine& routine : module.routines) {
    for (Rung& rung : routine.rungs) {
      enter.firstArg = 0;
      leave.firstArg = static_cast<uint32_t>(rung.args.size());
      rung.ops.reserve(rung.ops.size() + 2);
      rung.ops.insert(rung.ops.begin(), enter);
      rung.ops.push_back(leave);
    }
  }
  module.instrumented = true;
}

} // namespace rung::ir
