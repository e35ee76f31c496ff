// Profiles a program while scenarios drive it. The scenarios run several times, each time for one purpose, so that no
// measurement disturbs another:
//
//   once       on the interpreter, which counts operations: exact, the same in every run
//   N times    as the machine will run it: times of whole scans, slices and tasks
//   N times    with counters and clock around each rung
//   once       on the interpreter, where branches are to be counted
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
  std::vector<Scenario> scenarios;   // all of one program
  std::vector<std::string> programs; // instead of the files that the scenarios name, when not empty
  compiler::EngineKind engine = compiler::EngineKind::Jit;
  report::Order order = report::Order::Operations;
  uint32_t repeat = 5;                              // N
  std::function<void(const std::string&)> progress; // what is being done; may be empty
  ir::BranchCounts* branches = nullptr;             // what branches of rungs did is added there; null: not counted
};

struct ProfileOutcome {
  bool done = false;
  report::Profile profile;
  // When not done:
  std::string scenario; // the one that failed
  RunResult result;     // why
};

ProfileOutcome profileScenarios(const ProfileRequest& request);

} // namespace rung::scenario
