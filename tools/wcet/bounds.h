// The longest that a run of each task may take: in steps, as budgets count them, in machine instructions, and in time
// on this machine; and the heaviest way with its rungs.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ir/layout/heaviest.h"
#include "rtlib/host/engine.h"
#include "rtlib/host/scan_bound.h"
#include "tools/compiler/compile.h"

namespace rung::wcet {

// Numbers that follow one another.
struct Stretch {
  uint32_t first = 0;
  uint32_t last = 0;
  bool operator==(const Stretch&) const = default;
};

// What was seen in runs of a task, of a cut one: of its parts.
struct Seen {
  uint64_t runs = 0;
  uint64_t steps = 0; // of the heaviest
  double ns = 0;      // of the longest, each with the shortest of its times in several runs of the scenario
};

struct TaskBound {
  std::string name;
  uint32_t periodUs = 0; // 0: only when the schedule or the control starts it
  uint32_t parts = 1;
  uint32_t budget = 0;
  ir::HeaviestWay way;
  uint64_t steps = 0; // of the way, or where that is less of the budget, which ends circles
  std::optional<uint64_t> instructions;
  std::string noInstructions; // why there are none
  bool callsHost = false;     // whose functions are not in the instructions
  double ns = 0;              // of the code, without border copies
  std::optional<Seen> seen;
};

// Of a program that was compiled.
struct Bounds {
  std::string program;
  std::vector<TaskBound> tasks;
  host::ScanBound slice; // of all, border copies included
  std::string measured;  // by what Seen was measured; "": nothing was
};

// `machineCode` runs the program's code as the bounds are to hold for it.
Result<Bounds> boundsOf(const compiler::Compiled& compiled, host::Engine& machineCode);

// As drawn; what is not drawn is left out.
std::vector<Stretch> drawnStretches(const std::vector<uint32_t>& rungs, const rung_program& program);
// Of the numbers themselves.
std::vector<Stretch> stretches(const std::vector<uint32_t>& numbers);

std::string textOf(const Bounds& bounds, const rung_program& program);
// docs/wcet-format.md
std::string jsonOf(const Bounds& bounds, const rung_program& program);

} // namespace rung::wcet
