// How regularly a thread scans: what it counts itself, for others to look at meanwhile.
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rung::rung_run {

struct Step {
  int64_t beginNs = 0;  // since the thread began
  int64_t periodNs = 0; // since the beginning of the step before
  int64_t lateNs = 0;   // after it was due
  int64_t tookNs = 0;
};

// Of all steps so far; each figure by itself, as the thread runs on.
struct StepFigures {
  uint64_t steps = 0;
  uint64_t overruns = 0; // steps that began a whole period late, or later
  int64_t shortestPeriodNs = 0;
  int64_t longestPeriodNs = 0;
  int64_t late99Ns = 0; // 99 % of the steps began no later than this; at most a quarter too high
  int64_t late999Ns = 0;
  int64_t latestNs = 0;
  int64_t meanNs = 0; // of the time that steps took
  struct Worst {
    int64_t tookNs = 0;
    int64_t beginNs = 0;
  };
  std::vector<Worst> worst; // the steps that took longest, at most three
};

class StepTimes {
public:
  // The scan thread.
  void add(const Step& step, bool isOverrun) noexcept;
  // Any thread.
  StepFigures figures() const;
  uint64_t steps() const noexcept { return steps_.load(std::memory_order_relaxed); }

private:
  static constexpr size_t kWorst = 3;
  static constexpr size_t kClasses = 256; // of lateness
  static size_t classOf(int64_t ns) noexcept;
  static int64_t endOf(size_t number) noexcept;
  void addWorst(const Step& step) noexcept;
  int64_t lateOf(uint64_t steps, double share) const;

  std::atomic<uint64_t> steps_{0}, overruns_{0};
  std::atomic<int64_t> shortest_{INT64_MAX}, longest_{0}, latest_{0}, sum_{0};
  std::array<std::atomic<uint64_t>, kClasses> late_{};
  struct WorstStep {
    std::atomic<int64_t> tookNs{0}, beginNs{0};
  };
  std::array<WorstStep, kWorst> worst_{}; // the longest first
};

} // namespace rung::rung_run
