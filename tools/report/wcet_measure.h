// What runs of the tasks took while a program is driven.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tools/report/wcet_bounds.h"
#include "tools/scenario/scenario.h"

namespace rung::report {

struct Drive {
  std::string name;                                        // that the measurement is shown under
  std::vector<std::pair<std::string, std::string>> config; // of the control
  std::vector<scenario::Statement> connects;
  std::vector<scenario::Statement> statements;
};

// Fills Bounds::tasks[..].seen; on the interpreter for steps, on `machineCode` for times. What is wrong: why the
// program cannot be driven so.
Result<void> measure(const compiler::Compiled& compiled, runtime::Engine& machineCode, const Drive& drive,
                     Bounds& bounds);

} // namespace rung::report
