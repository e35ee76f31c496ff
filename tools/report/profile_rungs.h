// Reads the counters of an instrumented program between its scans: how often each rung ran, and what it cost in each
// scan. The engine determines the unit of the counters: ticks of the clock, or operations. Nothing allocates after
// construction, so a host may use it beside a running machine.
//
//   ProfileCollector collector(program.rung_count, runtime::calibratedClock().costTicks);
//   collector.started(instance.profile());               // after every start
//   for (;;) { instance.scan(); collector.scanned(instance.profile()); }
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rtlib/record/histogram.h"
#include "rtlib/record/profile_clock.h"
#include "rung/program.h"
#include "tools/report/scan_times.h"

namespace rung::report {

class ProfileCollector {
public:
  struct Rung {
    uint64_t executions = 0;
    double total = 0;   // without the cost of measuring
    uint64_t scans = 0; // number of scans in which it ran
    // Cost per scan in which it ran. It includes the cost of measuring one execution: a clock with coarse steps
    // sometimes shows less than that cost, so only means can be corrected by it.
    runtime::Histogram perScan;
  };

  // `cost`: what measuring one execution adds, in the unit of the counters.
  ProfileCollector(uint32_t rungs, double cost) : cost_(cost), rungs_(rungs), last_(rungs), scan_(rungs) {}

  // A start has reset the counters to 0, of this instance or another one: what they show now belongs to no scan.
  void started(std::span<const rung_prof> counters) noexcept;
  // One scan has run since the last call.
  void scanned(std::span<const rung_prof> counters) noexcept;

  uint64_t scans() const { return scans_; }
  std::span<const Rung> rungs() const { return rungs_; }
  double cost() const { return cost_; }
  // What each rung took in the last scan, without the cost of measuring; 0 if it did not run.
  std::span<const uint64_t> lastScan() const { return scan_; }
  uint64_t lastScanTotal() const { return scanTotal_; }

private:
  double take(size_t rung, const rung_prof& counter) noexcept;

  double cost_;
  std::vector<Rung> rungs_;
  std::vector<rung_prof> last_;
  std::vector<uint64_t> scan_;
  uint64_t scanTotal_ = 0;
  uint64_t scans_ = 0;
};

// Reports on an instrumented program: the cost of each rung, from the counters that collectors have read.

enum class Order : uint8_t {
  Operations, // operations executed in a run: exact, the same in every run
  Time,       // by Row::time
};

// One rung. Counts are of one run; times are nanoseconds per scan in which the rung ran, without the cost of measuring.
struct Row {
  uint32_t rung = 0;   // index in rung_program::rungs
  uint32_t number = 0; // as drawn; 0: a rung that the compiler added
  uint64_t key = 0;
  std::string routine;
  std::string title;
  std::string file;
  uint32_t line = 0;
  uint64_t executions = 0;
  uint64_t operations = 0;
  uint64_t scans = 0; // number of scans in which it ran
  double minNs = 0;
  double medianNs = 0;
  double meanNs = 0; // mean over all scans but the slowest hundredth: a clock with steps of 10 ns has no finer median
  double p99Ns = 0;
  double maxNs = 0;
  double time = 0;  // `scans` times `meanNs`: the rung's cost without disturbances
  double share = 0; // share of the sum of what the rows are ordered by, 0 to 1
};

struct ProfileReport {
  std::string program;
  std::string dialect;
  Order order = Order::Operations;
  runtime::ProfileClock clock;
  std::vector<Row> rows;  // rungs that ran
  std::vector<Row> added; // rungs added by the compiler that ran
  std::vector<Row> never; // rungs of the source that did not run, in the program's order
  uint64_t operations = 0;
  double time = 0;
};

// `operations` counted operations in one run of the program, `ticks` clock ticks in one or several runs; either may be
// null. Without operations, the rows are ordered by time.
ProfileReport makeReport(const rung_program& program, const ProfileCollector* operations, const ProfileCollector* ticks,
                         const runtime::ProfileClock& clock, Order order);

// A rung that cost more in one scan than it usually does.
struct Cause {
  Row row;
  double value = 0;
  double usual = 0;      // median over all scans
  bool onlyThen = false; // whether it ran in no other scan
};

// The scan that cost the most. Costs are in operations or nanoseconds.
struct WorstScan {
  bool known = false;
  std::string scenario;
  uint64_t scan = 0;  // number in this scenario, from 1
  int64_t timeUs = 0; // at its end
  std::string file;   // position of the statement that ran it
  uint32_t line = 0;
  double value = 0;
  double usual = 0;          // median over all scans
  std::vector<Cause> causes; // in descending order of the difference
};

struct Profile {
  ProfileReport report;
  std::string engine;
  std::vector<std::string> scenarios;
  uint64_t codeHash = 0;
  uint64_t scans = 0; // number of scans in one run
  uint32_t repeat = 0;
  Spread scanOperations;
  std::vector<Deadline> deadlines; // the whole scan first
  double measuredScanNs = 0;       // median of a whole scan with counters and clock running
  WorstScan worstByOperations;
  WorstScan worstByTime;
};

enum class SumBy : uint8_t { Routine, Module, File };

struct Sum {
  std::string name;
  uint32_t rungs = 0;
  uint32_t ran = 0;
  uint64_t executions = 0;
  uint64_t operations = 0;
  double time = 0;
  double share = 0; // as Row::share
};

// Sums in descending order. A module is the part of a routine's name before the dot; rungs added by the compiler may be
// in no file.
std::vector<Sum> sums(const ProfileReport& report, SumBy by);

// The rung's place, as in the text of a fault: rung 7 "title", main.pmc:40; for a rung added by the compiler MAIN,
// main.pmc:1.
std::string placeText(const Row& row);
// Tables of at most `limit` lines; 0: all.
std::string rungTable(const ProfileReport& report, uint32_t limit);
std::string sumTable(const std::vector<Sum>& sums, const char* what, uint32_t limit);

} // namespace rung::report
