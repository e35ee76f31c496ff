// What runs of the tasks took while a program is driven.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tools/report/wcet_bounds.h"
#include "tools/scenario/scenario.h"

namespace rung::scenario {

struct TaskDrive {
  std::string name;                                        // that the measurement is shown under
  std::vector<std::pair<std::string, std::string>> config; // of the control
  std::vector<Statement> connects;
  std::vector<Statement> statements;
};

// Fills Bounds::tasks[..].seen; on the interpreter for steps, on `machineCode` for times. What is wrong: why the
// program cannot be driven so.
Result<void> measureTasks(const compiler::Compiled& compiled, runtime::Engine& machineCode, const TaskDrive& drive,
                          report::Bounds& bounds);

} // namespace rung::scenario
