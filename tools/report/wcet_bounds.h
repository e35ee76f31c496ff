// The host functions that programs call (rung_host_api), and the cost of a call on this computer.
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
  ir::OpCode operation{}; // the operation that calls it; the function has the operation's name
  double ns = 0;          // time of a call
};

// Measures the runtime's queues, empty and full: for each function the most expensive of many calls, each with the
// fastest of its times. A control that answers within a request is not included.
std::vector<HostFunction> measureHostFunctions();

// Bounds of one run of each task: in steps, as budgets count them, in machine instructions, in calls of host functions,
// and in time on this computer; and the longest path with its rungs.

struct HostCalls {
  HostFunction function;
  uint64_t count = 0;
  double ns() const { return static_cast<double>(count) * function.ns; }
};

// Measured runs of a task; of a partitioned task, of its parts.
struct Seen {
  uint64_t runs = 0;
  uint64_t steps = 0; // of the longest run
  double ns = 0;      // of the longest run; the time of each run is the shortest over several runs of the scenario
};

struct TaskBound {
  std::string name;
  uint32_t periodUs = 0; // 0: started only by the schedule or the control
  uint32_t parts = 1;    // of a partitioned task, the values below are those of the part with the largest value
  uint32_t budget = 0;
  ir::LongestPath path;
  uint64_t steps = 0;                   // of the longest path, at most the budget; with loops the budget
  std::optional<uint64_t> instructions; // of the program's code, without host functions
  std::string noInstructions;           // why `instructions` is missing
  std::vector<HostCalls> calls;         // for each function the most calls of a run
  double codeNs = 0;                    // without process-image copies
  std::optional<Seen> seen;

  double callsNs() const;
  double ns() const { return codeNs + callsNs(); }
};

// The bounds of a compiled program.
struct Bounds {
  std::string program;
  std::vector<std::string> routines; // by id
  std::vector<TaskBound> tasks;
  runtime::ScanBound slice; // the bound of a replacement: including process-image copies
  std::string measured;     // how `seen` was measured; "": not measured
};

// compileWithLengths: the machine code to which the bounds apply, compiled once both for its lengths and for measuring
// its speed.
Result<std::unique_ptr<codegen::JitEngine>> compileWithLengths(const compiler::Compiled& compiled);
Bounds boundsOf(const compiler::Compiled& compiled, codegen::JitEngine& machineCode);

// Consecutive numbers.
struct Stretch {
  uint32_t first = 0;
  uint32_t last = 0;
  bool operator==(const Stretch&) const = default;
};
std::vector<Stretch> stretches(const std::vector<uint32_t>& numbers);
// The numbers of the drawn rungs among `rungs`; others are left out.
std::vector<Stretch> drawnStretches(const std::vector<uint32_t>& rungs, const rung_program& program);

std::string textOf(const Bounds& bounds, const rung_program& program);
// The format is described in docs/wcet-format.md.
std::string jsonOf(const Bounds& bounds, const rung_program& program);

// The maximum cost of a run of a task, for any cost that rungs have.

class TaskCost {
public:
  // `loops`: as in LongestPath. The partition must outlive this.
  TaskCost(const ir::Partition& partition, ir::TaskId task, const std::vector<std::vector<uint32_t>>& loops);

  // Whether a run may reach the chunk.
  bool reaches(const ir::Chunk& chunk) const { return uses_[chunk.routine.index] != Use::None; }
  // `costs`: by rung number (ir/analysis/rung_costs.h). Of a partitioned task, the cost of its most expensive part.
  uint64_t most(std::span<const uint64_t> costs) const;

private:
  enum class Use : uint8_t {
    None,
    Once,  // called outside of loops only
    Again, // called in a loop, too
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
  std::vector<bool> inLoop_; // by rung number
  std::vector<Use> uses_;    // by routine
};

} // namespace rung::report
