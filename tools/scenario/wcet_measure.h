// Measures runs of the tasks while a program is driven.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tools/report/wcet_bounds.h"
#include "tools/scenario/scenario.h"

namespace rung::scenario {

struct TaskDrive {
  std::string name;                                        // name of the measurement in the output
  std::vector<std::pair<std::string, std::string>> config; // configuration of the control
  std::vector<Statement> connects;
  std::vector<Statement> statements;
};

// Fills Bounds::tasks[..].seen: steps on the interpreter, times on `machineCode`. The error says why the program cannot
// be driven.
Result<void> measureTasks(const compiler::Compiled& compiled, runtime::Engine& machineCode, const TaskDrive& drive,
                          report::Bounds& bounds);

} // namespace rung::scenario
