// Compiles the program of a scenario with its configuration and checks its expect_error and expect_warning statements.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tools/compiler/compile.h"
#include "tools/scenario/scenario.h"

namespace rung::scenario {

struct CompileStep {
  std::optional<compiler::Compiled> program; // nothing when there is nothing to run: errors, expected or not
  std::vector<Problem> problems;
  std::vector<std::string> files; // of the sources, with those that they include
  std::string environment;        // a file that cannot be read
};

// `instrument`, `marks`: see CompileRequest. `programs`: instead of the files that the scenario names, when not empty.
CompileStep compileProgram(const Scenario& scenario, const std::vector<std::string>& programs, bool strict,
                           bool instrument, bool marks);

// Whether the compiler itself reads this configuration key; the rest is for the simulated NC.
bool readsKey(const frontend::Dialect& dialect, std::string_view key);

} // namespace rung::scenario
