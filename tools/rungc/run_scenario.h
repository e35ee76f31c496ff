// `rungc run --scenario FILE`: which program a scenario runs, how it starts it, and its statements.
#pragma once
#include <string>
#include <vector>

#include "tools/rungc/commands.h"
#include "tools/scenario/scenario.h"

namespace rung::rungc {

struct RunScenario {
  std::vector<scenario::Statement> statements; // for the running program
  std::vector<scenario::Statement> connects;
  int64_t periodUs = 0; // 0: the program's own
};

// Reads the file. Program, dialect and configuration go into the options, before those of the command line; where the
// options name files, those are the program. Gives the exit status; mistakes are printed.
int readRunScenario(const std::string& path, SourceOptions& options, RunScenario& scenario);

} // namespace rung::rungc
