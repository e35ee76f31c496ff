// Counts the steps of runs of tasks while the interpreter runs them: of whole tasks, and of the parts of partitioned
// ones.
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "ir/analysis/rung_costs.h"
#include "ir/interp/interp.h"
#include "rtlib/run/instance.h"

namespace rung::report {

class StepCounter final : public runtime::TaskWatch {
public:
  struct Count {
    uint64_t runs = 0;
    uint64_t most = 0; // most steps of a run
  };

  explicit StepCounter(size_t tasks) : counts_(tasks) {}

  // An observer for an interpreter of the program with this partition. The counter must outlive it.
  std::unique_ptr<ir::RungObserver> observer(const ir::Partition& partition) {
    return std::make_unique<Weigher>(partition, steps_);
  }
  // By task.
  const std::vector<Count>& counts() const { return counts_; }

  void begins(const runtime::Instance&, uint32_t) override { steps_ = 0; }
  void ended(const runtime::Instance&, uint32_t task) override {
    ++counts_[task].runs;
    counts_[task].most = std::max(counts_[task].most, steps_);
  }

private:
  class Weigher final : public ir::RungObserver {
  public:
    Weigher(const ir::Partition& partition, uint64_t& steps) : weights_(ir::rungWeights(partition)), steps_(steps) {}
    void rungRan(uint32_t number, std::span<const uint64_t>) override { steps_ += weights_[number]; }

  private:
    std::vector<uint64_t> weights_;
    uint64_t& steps_;
  };

  uint64_t steps_ = 0; // of the current run
  std::vector<Count> counts_;
};

} // namespace rung::report
