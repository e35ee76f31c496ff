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
#include <vector>

#include "rtlib/record/histogram.h"
#include "rung/program.h"

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

} // namespace rung::report
