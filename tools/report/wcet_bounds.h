// The functions of the host that programs call (rung_host_api), and what a call costs on this machine.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "codegen/jit/jit_engine.h"
#include "compiler/compile.h"
#include "ir/analysis/longest_path.h"
#include "ir/core/op_code.h"
#include "rtlib/run/scan_bound.h"

namespace rung::report {

struct HostFunction {
  ir::OpCode operation{}; // that calls it; its name is that of the function
  double ns = 0;          // of a call
};

// Of the runtime's queues, empty and full: the dearest of many calls, each with the fastest of its times. What a
// control does that answers within a request is not in them.
std::vector<HostFunction> measureHostFunctions();

// The longest that a run of each task may take: in steps, as budgets count them, in machine instructions, in calls of
// the host's functions, and in time on this machine; and the longest path with its rungs.

struct HostCalls {
  HostFunction function;
  uint64_t count = 0;
  double ns() const { return static_cast<double>(count) * function.ns; }
};

// What was seen in runs of a task, of a cut one: of its parts.
struct Seen {
  uint64_t runs = 0;
  uint64_t steps = 0; // of the longest
  double ns = 0;      // of the longest, each with the shortest of its times in several runs of the scenario
};

struct TaskBound {
  std::string name;
  uint32_t periodUs = 0; // 0: only when the schedule or the control starts it
  uint32_t parts = 1;    // of a cut task all that follows is that of the part that has most of it
  uint32_t budget = 0;
  ir::LongestPath way;
  uint64_t steps = 0;                   // of the way, or where that is less of the budget, which ends loops
  std::optional<uint64_t> instructions; // of the program's code, without those of the host's functions
  std::string noInstructions;           // why there are none
  std::vector<HostCalls> calls;         // most of each function that a run may call
  double codeNs = 0;                    // without process-image copies
  std::optional<Seen> seen;

  double callsNs() const;
  double ns() const { return codeNs + callsNs(); }
};

// Of a program that was compiled.
struct Bounds {
  std::string program;
  std::vector<std::string> routines; // by id
  std::vector<TaskBound> tasks;
  runtime::ScanBound slice; // the bound of a replacement: including process-image copies
  std::string measured;     // by what Seen was measured; "": nothing was
};

// The program's code as the bounds hold for it, once for both: its length, and how fast it is.
Result<std::unique_ptr<codegen::JitEngine>> compileWithLengths(const compiler::Compiled& compiled);
Bounds boundsOf(const compiler::Compiled& compiled, codegen::JitEngine& machineCode);

// Numbers that follow one another.
struct Stretch {
  uint32_t first = 0;
  uint32_t last = 0;
  bool operator==(const Stretch&) const = default;
};
std::vector<Stretch> stretches(const std::vector<uint32_t>& numbers);
// Of rungs as drawn; what is not drawn is left out.
std::vector<Stretch> drawnStretches(const std::vector<uint32_t>& rungs, const rung_program& program);

std::string textOf(const Bounds& bounds, const rung_program& program);
// docs/wcet-format.md
std::string jsonOf(const Bounds& bounds, const rung_program& program);

// The most that a run of a task may cost, in anything that rungs cost.

class TaskCost {
public:
  // `loops`: as LongestPath has them. The cut outlives this.
  TaskCost(const ir::Partition& partition, ir::TaskId task, const std::vector<std::vector<uint32_t>>& loops);

  // Whether a run may come to the chunk.
  bool reaches(const ir::Chunk& chunk) const { return uses_[chunk.routine.index] != Use::None; }
  // `costs`: by rung number (ir/analysis/rung_costs.h). Of a cut task: of the part that costs most.
  uint64_t most(std::span<const uint64_t> costs) const;

private:
  enum class Use : uint8_t {
    None,
    Once,  // it is called outside of loops only
    Again, // from within one, too
  };
  bool isRepeated(const ir::Chunk& chunk) const;
  uint64_t runsOf(ir::RoutineId routine, std::vector<std::optional<uint64_t>>& known) const;
  uint64_t costOf(const ir::Chunk& chunk, std::span<const uint64_t> costs) const;
  uint64_t allowed(std::span<const uint64_t> costs, bool repeatedOnly) const;
  uint64_t outsideOfLoops(std::span<const uint64_t> costs) const;
  template <class Visit>
  void forCalls(ir::RoutineId routine, Visit visit) const;

  const ir::Partition& partition_;
  ir::TaskId task_;
  bool hasLoops_;
  std::vector<bool> inCircle_; // by rung number
  std::vector<Use> uses_;      // by routine
};

} // namespace rung::report
