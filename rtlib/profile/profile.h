// Reports on the counters of an instrumented program: a row a rung that ran, sorted by total time.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rung/program.h"

namespace rung::profile {

// Nanoseconds of one tick of the cycle counter, measured against CLOCK_MONOTONIC once a process (about 10 ms).
double nsPerTick();

struct Row {
  uint32_t rung = 0; // in rung_program::rungs
  std::string routine;
  std::string title;
  std::string file;
  uint32_t line = 0;
  uint64_t executions = 0;
  double totalNs = 0;
  double meanNs = 0;
  double maxNs = 0;
  double share = 0; // of the total of all rungs, 0..1
};

struct Report {
  std::string program;
  std::string dialect;
  double totalNs = 0;
  uint32_t rungs = 0; // of the program; those without a row never ran
  std::vector<Row> rows;
};

// `counters` has an entry a rung (or none: the program is not instrumented, and the report is empty).
Report makeReport(const rung_program& program, std::span<const rung_prof> counters, double nanosecondsPerTick);

// A table of at most `limit` rows; 0: all.
std::string reportText(const Report& report, uint32_t limit = 0);
std::string reportJson(const Report& report);

} // namespace rung::profile
