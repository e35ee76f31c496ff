// Bounds as text for a terminal.
#include <algorithm>
#include <fmt/format.h>
#include <map>

#include "ir/core/op_info.h"
#include "tools/report/profile_text.h"
#include "tools/report/wcet_bounds.h"

namespace rung::report {
namespace {

constexpr size_t kWidth = 110;

std::string stretchText(const Stretch& s) {
  return s.first == s.last ? std::to_string(s.first) : fmt::format("{}-{}", s.first, s.last);
}

// Text in lines of a width; those after the first begin with the indent.
std::string wrapped(std::string text, const std::string& indent) {
  for (size_t line = 0; text.size() - line > kWidth;) {
    size_t end = text.rfind(' ', line + kWidth);
    if (end == std::string::npos || end <= text.find_first_not_of(' ', line)) end = text.find(' ', line + kWidth);
    if (end == std::string::npos) break;
    text.replace(end, 1, "\n" + indent);
    line = end + 1;
  }
  return text + "\n";
}

std::string counted(uint64_t steps) { return fmt::format("{} step{}", steps, steps == 1 ? "" : "s"); }

std::string rungsText(const std::vector<uint32_t>& rungs, const rung_program& program) {
  const std::vector<Stretch> drawn = drawnStretches(rungs, program);
  if (drawn.empty()) return "only rungs added by the compiler";
  std::string text = drawn.size() == 1 && drawn[0].first == drawn[0].last ? "rung" : "rungs";
  for (size_t i = 0; i < drawn.size(); ++i) text += (i == 0 ? " " : ", ") + stretchText(drawn[i]);
  return text;
}

// Where the way calls, in the order of the first call of each.
std::string calleesText(const ir::RoutineWay& way, const Bounds& bounds, const rung_program& program) {
  std::vector<ir::RoutineId> order;
  std::map<uint32_t, std::vector<uint32_t>> callers; // rungs
  for (const ir::RoutineWay::Call& call : way.calls) {
    std::vector<uint32_t>& rungs = callers[call.callee.index];
    if (rungs.empty()) order.push_back(call.callee);
    rungs.push_back(call.rung);
  }
  std::string text;
  for (const ir::RoutineId callee : order)
    text += fmt::format("{} {} from {}", text.empty() ? "; calls" : ",", bounds.routines[callee.index],
                        rungsText(callers[callee.index], program));
  return text;
}

std::string wayText(const TaskBound& task, const Bounds& bounds, const rung_program& program) {
  std::string text;
  for (const ir::RoutineWay& way : task.way.routines) {
    std::string line = "  " + bounds.routines[way.routine.index];
    if (&way == &task.way.routines[0] && task.parts > 1) line += fmt::format(", part {}", task.way.part + 1);
    if (&way != &task.way.routines[0]) line += ", " + counted(way.cost);
    if (way.runs != 1) line += fmt::format(", {} times", way.runs);
    text += wrapped(line + ": " + rungsText(way.rungs, program) + calleesText(way, bounds, program), "    ");
  }
  return text;
}

std::string loopText(const std::vector<uint32_t>& rungs, const rung_program& program) {
  return fmt::format("{}, {}", rungsText(rungs, program), program.routines[program.rungs[rungs.front()].routine]);
}

std::string loopsText(const TaskBound& task, const rung_program& program) {
  std::string text;
  for (const std::vector<uint32_t>& rungs : task.way.circles)
    text += wrapped(fmt::format("  loop: {}", loopText(rungs, program)), "    ");
  if (text.empty()) return text;
  return text + fmt::format("  the budget of {} steps ends the run; with each loop run once, the longest path has {}\n",
                            task.budget, task.way.cost);
}

std::string stepsText(const TaskBound& task) {
  if (!task.way.circles.empty()) return counted(task.budget) + ", the whole budget: the program may loop";
  if (task.way.cost > task.budget)
    return fmt::format("{}, the whole budget: the longest path has {}", counted(task.budget), task.way.cost);
  return fmt::format("{} of a budget of {}", counted(task.way.cost), task.budget);
}

std::string seenText(const TaskBound& task) {
  if (!task.seen) return {};
  if (task.seen->runs == 0) return "  measured: the task did not run\n";
  return fmt::format("  measured in {} {}{}: {}, {} including process-image copies\n", task.seen->runs,
                     task.parts > 1 ? "part" : "run", task.seen->runs == 1 ? "" : "s", counted(task.seen->steps),
                     durationText(task.seen->ns));
}

// "at most 3 calls of message, 2 of service_poll"
std::string callsText(const TaskBound& task) {
  std::string text;
  for (const HostCalls& calls : task.calls) {
    const std::string_view unit = !text.empty() ? "" : calls.count == 1 ? "call " : "calls ";
    text += fmt::format("{}{} {}of {}", text.empty() ? "at most " : ", ", calls.count, unit,
                        ir::opInfo(calls.function.operation).name);
  }
  return text;
}

std::string instructionsText(const TaskBound& task) {
  std::string text = task.instructions ? std::to_string(*task.instructions) : "no bound, " + task.noInstructions;
  if (!task.calls.empty()) text += (task.instructions ? ", and " : "; ") + callsText(task);
  return fmt::format("  machine instructions: {}\n", text);
}

std::string timeText(const TaskBound& task) {
  std::string text = durationText(task.ns());
  if (!task.calls.empty()) text += fmt::format(", {} of it in these calls", durationText(task.callsNs()));
  return fmt::format("  time on this computer: {}\n", text);
}

std::string taskText(const TaskBound& task, const Bounds& bounds, const rung_program& program) {
  std::string text = task.parts > 1 ? fmt::format("{}, a part of {}", task.name, task.parts) : task.name;
  text += fmt::format(": at most {}\n", stepsText(task));
  text += instructionsText(task) + timeText(task);
  return text + seenText(task) + loopsText(task, program) + wayText(task, bounds, program);
}

// The bound of a slice has each loop once; what the budgets allow is said beside it.
std::string sliceText(const Bounds& bounds, const rung_program& program) {
  std::string loops;
  double most = 0;
  for (const TaskBound& task : bounds.tasks) {
    for (const std::vector<uint32_t>& rungs : task.way.circles)
      loops += (loops.empty() ? "" : "; ") + loopText(rungs, program);
    if (!task.way.circles.empty()) most = std::max(most, task.ns());
  }
  const std::string bound = boundText(bounds.slice, program);
  if (loops.empty()) return wrapped("longest slice, including process-image copies: " + bound, "  ");
  return wrapped(fmt::format("longest slice, including process-image copies, each loop ({}) counted once: {}; a run "
                             "that loops may last {}",
                             loops, bound, durationText(most)),
                 "  ");
}

} // namespace

std::string textOf(const Bounds& bounds, const rung_program& program) {
  std::string text;
  for (const TaskBound& task : bounds.tasks) text += taskText(task, bounds, program) + "\n";
  text += sliceText(bounds, program);
  if (!bounds.measured.empty()) text += fmt::format("measured: {}\n", bounds.measured);
  return text;
}

} // namespace rung::report
