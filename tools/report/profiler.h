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
#include "tools/report/scan_times.h"
#include "tools/scenario/runner.h"

namespace rung::report {

struct Request {
  std::vector<scenario::Scenario> scenarios; // all of one program
  std::vector<std::string> programs;         // instead of the files that the scenarios name, when not empty
  compiler::EngineKind engine = compiler::EngineKind::Jit;
  Order order = Order::Operations;
  uint32_t repeat = 5;                              // N
  std::function<void(const std::string&)> progress; // what is being done; may be empty
  ir::BranchCounts* branches = nullptr;             // what branches of rungs did is added there; null: not counted
};

// A rung that did more in one scan than it usually does.
struct Cause {
  Row row;
  double value = 0;
  double usual = 0;      // median of all scans
  bool onlyThen = false; // it ran in no other scan
};

// The scan that took the most. What it took and what is usual: operations, or nanoseconds.
struct WorstScan {
  bool known = false;
  std::string scenario;
  uint64_t scan = 0;  // of this scenario, from 1
  int64_t timeUs = 0; // when it ended
  std::string file;   // of the statement that ran it
  uint32_t line = 0;
  double value = 0;
  double usual = 0;          // median of all scans
  std::vector<Cause> causes; // the largest difference first
};

struct Profile {
  ProfileReport report;
  std::string engine;
  std::vector<std::string> scenarios;
  uint64_t codeHash = 0;
  uint64_t scans = 0; // of one run
  uint32_t repeat = 0;
  Spread scanOperations;
  std::vector<Deadline> deadlines; // the whole scan first
  double measuredScanNs = 0;       // median of a whole scan with counters and clock
  WorstScan worstByOperations;
  WorstScan worstByTime;
};

struct Outcome {
  bool done = false;
  Profile profile;
  // When not done:
  std::string scenario;       // the one that failed
  scenario::RunResult result; // why
};

Outcome profileScenarios(const Request& request);

} // namespace rung::report
