// Profiles a program while scenarios drive it. The scenarios run several times, each time for one purpose, so that no
// measurement disturbs another:
//
//   once       on the interpreter, which counts operations: exact, the same in every run
//   N times    on the engine that the machine will use: times of whole scans, slices and tasks
//   N times    with counters and clock around each rung
//   once       on the interpreter, if branches are to be counted
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "compiler/engines.h"
#include "ir/analysis/branch_weights.h"
#include "tools/report/profile_rungs.h"
#include "tools/scenario/runner.h"

namespace rung::scenario {

struct ProfileRequest {
  std::vector<Scenario> scenarios;   // all of them run the same program
  std::vector<std::string> programs; // if not empty, they replace the files that the scenarios name
  compiler::EngineKind engine = compiler::EngineKind::Jit;
  report::Order order = report::Order::Operations;
  uint32_t repeat = 5;                              // the N above
  std::function<void(const std::string&)> progress; // called with a description of each stage; may be empty
  ir::BranchCounts* branches = nullptr;             // counts of branches are added to it; null: not counted
};

struct ProfileOutcome {
  bool done = false;
  report::Profile profile;
  // If not done:
  std::string scenario; // the scenario that failed
  RunResult result;     // why it failed
};

ProfileOutcome profileScenarios(const ProfileRequest& request);

} // namespace rung::scenario
