// The most that a run of a task may cost, in anything that rungs cost.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ir/analysis/heaviest.h"

namespace rung::report {

class TaskCost {
public:
  // `circles`: as HeaviestWay has them. The cut outlives this.
  TaskCost(const ir::Cut& cut, ir::TaskId task, const std::vector<std::vector<uint32_t>>& circles);

  // Whether a run may come to the chunk.
  bool reaches(const ir::Chunk& chunk) const { return uses_[chunk.routine.index] != Use::None; }
  // `costs`: by rung number (ir/analysis/rung_costs.h). Of a cut task: of the part that costs most.
  uint64_t most(std::span<const uint64_t> costs) const;

private:
  enum class Use : uint8_t {
    None,
    Once,  // it is called outside of circles only
    Again, // from within one, too
  };
  bool isRepeated(const ir::Chunk& chunk) const;
  uint64_t runsOf(ir::RoutineId routine, std::vector<std::optional<uint64_t>>& known) const;
  uint64_t costOf(const ir::Chunk& chunk, std::span<const uint64_t> costs) const;
  uint64_t allowed(std::span<const uint64_t> costs, bool repeatedOnly) const;
  uint64_t outsideOfCircles(std::span<const uint64_t> costs) const;
  template <class Visit>
  void forCalls(ir::RoutineId routine, Visit visit) const;

  const ir::Cut& cut_;
  ir::TaskId task_;
  bool hasCircles_;
  std::vector<bool> inCircle_; // by rung number
  std::vector<Use> uses_;      // by routine
};

} // namespace rung::report
