// Times of whole scans, slices and runs of tasks, of the program alone: what the simulated NC does between them does
// not count. A scenario does the same work in every run, so each piece of it keeps the shortest time of all runs: what
// remains is the program's, whatever else the machine did meanwhile.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "rtlib/record/profile_clock.h"
#include "rtlib/run/instance.h"

namespace rung::report {

// The pieces of a run in their order, each with the shortest of its times so far.
class Shortest {
public:
  void rewind() { next_ = 0; }
  void add(uint64_t ticks);
  const std::vector<uint64_t>& values() const { return values_; }

private:
  std::vector<uint64_t> values_;
  size_t next_ = 0;
};

struct Spread {
  uint64_t count = 0;
  double min = 0;
  double mean = 0;
  double median = 0;
  double p99 = 0;
  double max = 0;
};

// Of all values times `scale`.
Spread spreadOf(std::vector<uint64_t> values, double scale);

// Something that has to be done in a time.
struct Deadline {
  std::string name;    // "scan", "slice of 8 ms", a task
  double periodUs = 0; // 0: none
  Spread ns;
};

// Watches the tasks of one program through all runs.
class ScanTimes final : public runtime::TaskWatch {
public:
  // A run of all scenarios begins.
  void rewind();
  // A new instance of a scenario.
  void started(const runtime::Instance& instance);
  // What has run since the last call was a scan, whole or not.
  void scanned(bool whole);

  void begins(const runtime::Instance& instance, uint32_t task) override;
  void ended(const runtime::Instance& instance, uint32_t task) override;

  const Shortest& scans() const { return scans_; }
  const std::vector<Shortest>& tasks() const { return tasks_; } // runs of each; empty before a start
  // The scan, its slices when it has several, and each task that ran.
  std::vector<Deadline> deadlines(const rung_program& program, const runtime::ProfileClock& clock) const;

private:
  void endSlice();

  double cost_ = runtime::calibratedClock().costTicks;
  Shortest scans_;
  Shortest slices_;
  std::vector<Shortest> tasks_;
  uint64_t start_ = 0;
  uint64_t scan_ = 0;  // ticks so far
  uint64_t slice_ = 0; // ticks so far
  int64_t sliceUs_ = -1;
};

// Microseconds of the shortest slice of a scan.
uint64_t slicePeriodUs(const rung_program& program);

} // namespace rung::report
