// The functions of the host that programs call (rung_host_api), and what a call costs on this machine.
#pragma once
#include <vector>

#include "ir/core/op_code.h"

namespace rung::report {

struct HostFunction {
  ir::OpCode operation{}; // that calls it; its name is that of the function
  double ns = 0;          // of a call
};

// Of the runtime's queues, empty and full: the dearest of many calls, each with the fastest of its times. What a
// control does that answers within a request is not in them.
std::vector<HostFunction> measureHostFunctions();

} // namespace rung::report
