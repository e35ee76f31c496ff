// Times of whole scans, slices and runs of tasks, of the program alone, without the work of the simulated NC between
// them. A scenario does the same work in every run, so each scan, slice or task run keeps the shortest of its times
// over all runs: what remains is the program's own time, undisturbed by other load of the computer.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "rtlib/record/profile_clock.h"
#include "rtlib/run/instance.h"

namespace rung::report {

// The measured parts of a run in their order, each with its shortest time so far.
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

// Spread of all values, each multiplied by `scale`.
Spread spreadOf(std::vector<uint64_t> values, double scale);

// Measured times of something that must finish within its period.
struct Deadline {
  std::string name;    // "scan", "slice of 8 ms", a task
  double periodUs = 0; // 0: no period
  Spread ns;
};

// Measures the tasks of one program over all runs.
class ScanTimes final : public runtime::TaskWatch {
public:
  // Begins another run of all scenarios.
  void rewind();
  // A scenario has started a new instance.
  void started(const runtime::Instance& instance);
  // A scan, or with `whole` false a part of one, has run since the last call.
  void scanned(bool whole);

  void begins(const runtime::Instance& instance, uint32_t task) override;
  void ended(const runtime::Instance& instance, uint32_t task) override;

  const Shortest& scans() const { return scans_; }
  const std::vector<Shortest>& tasks() const { return tasks_; } // one entry per task; empty before a start
  // The whole scan, its slices if it has several, and each task that ran.
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

// The shortest slice of a scan, in microseconds.
uint64_t slicePeriodUs(const rung_program& program);

} // namespace rung::report
