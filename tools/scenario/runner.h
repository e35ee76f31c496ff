// Runs a scenario on one or several engines in step. With several engines, after every scan the memory, messages,
// services and fault of each are compared with the first engine's, whatever the scenario expects.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "compiler/engines.h"
#include "tools/scenario/compile_step.h"
#include "tools/scenario/scenario.h"
#include "tools/scenario/session.h"

namespace rung::scenario {

struct RunOptions {
  std::vector<compiler::EngineKind> engines; // at least one
  compiler::EngineOptions engine;
  bool instrument = false; // the program has profile counters
  bool strict = false;
  bool marks = false;                // the program is compiled with marks (compiler::CompileRequest::marks)
  std::vector<std::string> programs; // if not empty, they replace the scenario's program statement
  EngineStore* store = nullptr;      // keeps engines for later scenarios; must outlive the run
  // Called between the start and the first statement, to attach observers, which must outlive the run. Returns "" or
  // why the scenario cannot run.
  std::function<std::string(Session&, const compiler::Compiled&)> started;
  // Called after the last statement, or the one that failed. May be empty.
  std::function<void(Session&)> ended;
};

struct RunResult {
  bool passed = false;
  uint64_t scans = 0;
  std::vector<Problem> problems; // why it failed, with the lines of the scenario
  // Of the scenario, if the last problem is that a name has another value than it expects; otherwise null.
  const Statement* unexpected = nullptr;
  std::vector<std::string> printed; // output of print statements
  bool expectsNothing = false;      // a problem with RunOptions::strict
  std::vector<std::string> files;   // all files that were read: scenarios and sources
  std::string environment;          // not empty: why the scenario could not be run (no compiler, unreadable file)
};

// A scenario with parse problems does not run; its other problems are found all the same.
RunResult run(const Scenario& scenario, const RunOptions& options);

} // namespace rung::scenario
