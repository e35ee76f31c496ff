// Runs a scenario on one or several engines in step. With several, all memory, messages, services and the fault of each
// are compared with the first engine's after every scan, whatever the scenario expects.
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
  std::vector<std::string> programs; // instead of the scenario's own program statement, when not empty
  EngineStore* store = nullptr;      // keeps engines for the next scenario; it outlives the run
  // Called between the start and the first statement, to attach observers, which outlive the run. A text says why the
  // scenario cannot be run.
  std::function<std::string(Session&, const compiler::Compiled&)> started;
};

struct RunResult {
  bool passed = false;
  uint64_t scans = 0;
  std::vector<Problem> problems;    // why it failed, with the scenario's lines
  std::vector<std::string> printed; // by print statements
  bool expectsNothing = false;      // with RunOptions::strict that is a problem
  std::vector<std::string> files;   // that were read: scenarios and sources
  std::string environment;          // not empty: it could not be run (no compiler, unreadable file)
};

// A scenario with problems of its own does not run; what else is wrong with it is found all the same.
RunResult run(const Scenario& scenario, const RunOptions& options);

} // namespace rung::scenario
