// Reports on an instrumented program: what each rung did, from what collectors have read of its counters.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "rtlib/record/profile_clock.h"
#include "tools/report/profile_collector.h"

namespace rung::report {

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
