// Stopwatches around tasks (see scan_times.h).
#include "tools/report/scan_times.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

#include "rtlib/core/ticks.h"
#include "rtlib/load/program_info.h"
#include "rtlib/record/histogram.h"

namespace rung::report {

void Shortest::add(uint64_t ticks) {
  if (next_ < values_.size())
    values_[next_] = std::min(values_[next_], ticks);
  else
    values_.push_back(ticks);
  ++next_;
}

Spread spreadOf(std::vector<uint64_t> values, double scale) {
  Spread spread;
  if (values.empty()) return spread;
  std::sort(values.begin(), values.end());
  const auto at = [&](double q) {
    const auto nearest = static_cast<size_t>(std::llround(q * static_cast<double>(values.size() - 1)));
    return static_cast<double>(values[nearest]) * scale;
  };
  spread.count = values.size();
  spread.min = at(0);
  spread.mean = std::accumulate(values.begin(), values.end(), 0.0) * scale / static_cast<double>(values.size());
  spread.median = at(0.5);
  spread.p99 = at(0.99);
  spread.max = at(1);
  return spread;
}

// ---- schedule ----------------------------------------------------------------------------------------------------

uint64_t slicePeriodUs(const rung_program& program) {
  uint64_t shortest = runtime::scanPeriodUs(program);
  for (uint32_t i = 0; i < program.scan_count; ++i)
    if (program.scan[i].op == RUNG_STEP_ADVANCE) shortest = std::min<uint64_t>(shortest, program.scan[i].arg);
  return shortest;
}

// ---- watching ----------------------------------------------------------------------------------------------------

void ScanTimes::rewind() {
  scans_.rewind();
  slices_.rewind();
  for (Shortest& task : tasks_) task.rewind();
}

void ScanTimes::started(const runtime::Instance& instance) {
  tasks_.resize(instance.program().task_count);
  scan_ = 0;
  slice_ = 0;
  sliceUs_ = -1;
}

void ScanTimes::endSlice() {
  if (sliceUs_ >= 0) slices_.add(slice_);
  slice_ = 0;
  sliceUs_ = -1;
}

void ScanTimes::scanned(bool whole) {
  endSlice();
  if (whole) scans_.add(scan_);
  scan_ = 0;
}

void ScanTimes::begins(const runtime::Instance& instance, uint32_t task) {
  (void)task;
  if (sliceUs_ != instance.nowUs()) endSlice();
  sliceUs_ = instance.nowUs();
  start_ = core::readTicks();
}

void ScanTimes::ended(const runtime::Instance& instance, uint32_t task) {
  (void)instance;
  const double used = static_cast<double>(core::readTicks() - start_) - cost_;
  const uint64_t ticks = used <= 0 ? 0 : static_cast<uint64_t>(used);
  tasks_[task].add(ticks);
  slice_ += ticks;
  scan_ += ticks;
}

std::vector<Deadline> ScanTimes::deadlines(const rung_program& program, const runtime::ProfileClock& clock) const {
  const double scale = clock.nsPerTick;
  const uint64_t scanUs = runtime::scanPeriodUs(program);
  const uint64_t sliceUs = slicePeriodUs(program);
  std::vector<Deadline> deadlines;
  deadlines.push_back({"whole scan", static_cast<double>(scanUs), spreadOf(scans_.values(), scale)});
  if (sliceUs < scanUs)
    deadlines.push_back({"time slice", static_cast<double>(sliceUs), spreadOf(slices_.values(), scale)});
  for (uint32_t t = 0; t < tasks_.size(); ++t) {
    if (tasks_[t].values().empty()) continue;
    const rung_task& task = program.tasks[t];
    const uint32_t parts = std::max(1u, task.part_count);
    deadlines.push_back({parts > 1 ? fmt::format("part of {}", task.name) : std::string(task.name),
                         static_cast<double>(task.period_us) / parts, spreadOf(tasks_[t].values(), scale)});
  }
  return deadlines;
}

} // namespace rung::report
