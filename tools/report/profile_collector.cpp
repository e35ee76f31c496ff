// Differences of counters (see collector.h).
#include "tools/report/profile_collector.h"

#include <algorithm>
#include <cmath>

namespace rung::report {
namespace {

uint64_t roundedAbove0(double value) { return value <= 0 ? 0 : static_cast<uint64_t>(std::llround(value)); }

} // namespace

// What the counter has counted since it was last taken, without any cost; it may be less than nothing.
double ProfileCollector::take(size_t rung, const rung_prof& counter) noexcept {
  rung_prof& last = last_[rung];
  const uint64_t executions = counter.count - last.count;
  const double value = static_cast<double>(counter.total - last.total) - cost_ * static_cast<double>(executions);
  last = counter;
  rungs_[rung].executions += executions;
  rungs_[rung].total += value;
  return value;
}

void ProfileCollector::started(std::span<const rung_prof> counters) noexcept {
  std::fill(last_.begin(), last_.end(), rung_prof{});
  for (size_t i = 0; i < rungs_.size() && i < counters.size(); ++i) take(i, counters[i]);
}

void ProfileCollector::scanned(std::span<const rung_prof> counters) noexcept {
  ++scans_;
  scanTotal_ = 0;
  for (size_t i = 0; i < rungs_.size() && i < counters.size(); ++i) {
    scan_[i] = 0;
    if (counters[i].count == last_[i].count) continue;
    const double value = take(i, counters[i]);
    scan_[i] = roundedAbove0(value);
    scanTotal_ += scan_[i];
    ++rungs_[i].scans;
    rungs_[i].perScan.add(roundedAbove0(value + cost_));
  }
}

} // namespace rung::report
