// Reads the counters of an instrumented program between its scans: how often each rung ran, and what it took in each
// scan. What the counters count is the engine's: ticks of the clock, or operations. After construction nothing here
// allocates, so a host may use it beside a running machine.
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
    double total = 0;   // without any cost
    uint64_t scans = 0; // in which it ran
    // What it took in them. The cost of one execution is still in it: a clock with coarse steps shows less than its
    // cost now and then, and only means know how much a rung adds to it.
    runtime::Histogram perScan;
  };

  // `cost`: what measuring one execution adds.
  ProfileCollector(uint32_t rungs, double cost) : cost_(cost), rungs_(rungs), last_(rungs), scan_(rungs) {}

  // The counters have begun at 0 with a start, of this instance or another one: what they show belongs to no scan.
  void started(std::span<const rung_prof> counters) noexcept;
  // What has been counted since the last call was one scan.
  void scanned(std::span<const rung_prof> counters) noexcept;

  uint64_t scans() const { return scans_; }
  std::span<const Rung> rungs() const { return rungs_; }
  double cost() const { return cost_; }
  // What each rung took in the last scan, without any cost; 0 when it did not run.
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

// Reports on an instrumented program: what each rung did, from what collectors have read of its counters.

enum class Order : uint8_t {
  Operations, // executed in a run: exact, the same in every run
  Time,       // Row::time
};

// A rung. Counts are those of one run; times are nanoseconds of a scan in which the rung ran, without the cost of
// measuring.
struct Row {
  uint32_t rung = 0;   // in rung_program::rungs
  uint32_t number = 0; // as drawn; 0: the compiler made it
  uint64_t key = 0;
  std::string routine;
  std::string title;
  std::string file;
  uint32_t line = 0;
  uint64_t executions = 0;
  uint64_t operations = 0;
  uint64_t scans = 0; // in which it ran
  double minNs = 0;
  double medianNs = 0;
  double meanNs = 0; // of all scans but the slowest hundredth: a clock that steps in 10 ns has no finer median
  double p99Ns = 0;
  double maxNs = 0;
  double time = 0;  // `scans` times `meanNs`: what the rung costs when nothing else disturbs the machine
  double share = 0; // of the sum of what the rows are ordered by, 0..1
};

struct ProfileReport {
  std::string program;
  std::string dialect;
  Order order = Order::Operations;
  runtime::ProfileClock clock;
  std::vector<Row> rows;  // those that ran
  std::vector<Row> added; // those of the compiler that ran
  std::vector<Row> never; // the others of the source, as the program has them
  uint64_t operations = 0;
  double time = 0;
};

// `operations` counted operations while the program ran once, `ticks` the clock while it ran once or several times;
// either may be null. Without operations the order is that of the time.
ProfileReport makeReport(const rung_program& program, const ProfileCollector* operations, const ProfileCollector* ticks,
                         const runtime::ProfileClock& clock, Order order);

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

enum class SumBy : uint8_t { Routine, Module, File };

struct Sum {
  std::string name;
  uint32_t rungs = 0;
  uint32_t ran = 0;
  uint64_t executions = 0;
  uint64_t operations = 0;
  double time = 0;
  double share = 0; // as in Row
};

// The largest first. A module is the part of a routine's name before its dot; rungs of the compiler may be in no file.
std::vector<Sum> sums(const ProfileReport& report, SumBy by);

// As in the text of a fault: rung 7 "title", main.pmc:40; of a rung of the compiler MAIN, main.pmc:1.
std::string placeText(const Row& row);
// Tables of at most `limit` lines; 0: all.
std::string rungTable(const ProfileReport& report, uint32_t limit);
std::string sumTable(const std::vector<Sum>& sums, const char* what, uint32_t limit);

} // namespace rung::report
