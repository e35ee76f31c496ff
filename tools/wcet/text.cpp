// Bounds as text for a terminal.
#include <fmt/format.h>
#include <map>

#include "tools/profile/text.h"
#include "tools/wcet/bounds.h"

namespace rung::wcet {
namespace {

constexpr size_t kWidth = 110;

std::string stretchText(const Stretch& s) {
  return s.first == s.last ? std::to_string(s.first) : fmt::format("{}-{}", s.first, s.last);
}

// Words in lines of a width, those after the first with an indent.
std::string wrapped(std::string_view text, std::string_view indent) {
  std::string out;
  size_t column = 0;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    if (column != 0 && column + 1 + word.size() > kWidth) {
      out += '\n';
      out += indent;
      column = indent.size();
    } else if (column != 0) {
      out += ' ';
      ++column;
    }
    out += word;
    column += word.size();
  }
  return out + "\n";
}

std::string rungsText(const std::vector<uint32_t>& rungs, const rung_program& program) {
  const std::vector<Stretch> drawn = drawnStretches(rungs, program);
  if (drawn.empty()) return "no rung that is drawn";
  std::string text = drawn.size() == 1 && drawn[0].first == drawn[0].last ? "rung" : "rungs";
  for (size_t i = 0; i < drawn.size(); ++i) text += (i == 0 ? " " : ", ") + stretchText(drawn[i]);
  return text;
}

std::string_view routineName(ir::RoutineId routine, const rung_program& program) {
  return program.routines[routine.index];
}

// Where the way calls, in the order of the first call of each.
std::string callsText(const ir::RoutineWay& way, const rung_program& program) {
  std::vector<ir::RoutineId> order;
  std::map<uint32_t, std::vector<uint32_t>> callers; // rungs
  for (const ir::RoutineWay::Call& call : way.calls) {
    std::vector<uint32_t>& rungs = callers[call.callee.index];
    if (rungs.empty()) order.push_back(call.callee);
    rungs.push_back(call.rung);
  }
  std::string text;
  for (const ir::RoutineId callee : order)
    text += fmt::format("{} {} from {}", text.empty() ? "; calls" : ",", routineName(callee, program),
                        rungsText(callers[callee.index], program));
  return text;
}

std::string wayText(const TaskBound& task, const rung_program& program) {
  std::string text;
  for (const ir::RoutineWay& way : task.way.routines) {
    std::string line = fmt::format("  {}", routineName(way.routine, program));
    if (&way == &task.way.routines[0] && task.parts > 1) line += fmt::format(", part {}", task.way.part + 1);
    if (&way != &task.way.routines[0])
      line +=
          way.runs == 1 ? fmt::format(", {} steps", way.cost) : fmt::format(", {} steps, {} times", way.cost, way.runs);
    text += wrapped(line + ": " + rungsText(way.rungs, program) + callsText(way, program), "    ");
  }
  return text;
}

std::string circlesText(const TaskBound& task, const rung_program& program) {
  std::string text;
  for (const std::vector<uint32_t>& circle : task.way.circles)
    text += wrapped(fmt::format("  in a circle: {}, {}", rungsText(circle, program),
                                routineName(ir::RoutineId{program.rungs[circle.front()].routine}, program)),
                    "    ");
  if (text.empty()) return text;
  return text + fmt::format("  the budget of {} steps ends the run; without a circle the heaviest way has {}\n",
                            task.budget, task.way.cost);
}

std::string stepsText(const TaskBound& task) {
  if (!task.way.circles.empty()) return fmt::format("{} steps, its budget: control may go in circles", task.budget);
  if (task.way.cost > task.budget)
    return fmt::format("{} steps, its budget: the heaviest way has {}", task.budget, task.way.cost);
  return fmt::format("{} steps of a budget of {}", task.way.cost, task.budget);
}

std::string seenText(const TaskBound& task) {
  if (!task.seen) return {};
  if (task.seen->runs == 0) return "  measured: it was not run\n";
  return fmt::format("  measured in {} {}{}: {} steps, {}\n", task.seen->runs, task.parts > 1 ? "part" : "run",
                     task.seen->runs == 1 ? "" : "s", task.seen->steps, profile::durationText(task.seen->ns));
}

std::string instructionsText(const TaskBound& task) {
  if (!task.instructions) return fmt::format("  machine instructions: no bound, {}\n", task.noInstructions);
  return fmt::format("  machine instructions: {}{}\n", *task.instructions,
                     task.callsHost ? ", without those of the control's functions that it calls" : "");
}

std::string taskText(const TaskBound& task, const rung_program& program) {
  std::string text = task.parts > 1 ? fmt::format("{}, a part of {}", task.name, task.parts) : task.name;
  text += fmt::format(": at most {}\n", stepsText(task));
  text += instructionsText(task);
  text += fmt::format("  time on this machine: {}\n", profile::durationText(task.ns));
  return text + seenText(task) + circlesText(task, program) + wayText(task, program);
}

} // namespace

std::string textOf(const Bounds& bounds, const rung_program& program) {
  std::string text;
  for (const TaskBound& task : bounds.tasks) text += taskText(task, program) + "\n";
  text += wrapped("longest slice with its copies: " + boundText(bounds.slice, program), "  ");
  if (!bounds.measured.empty()) text += fmt::format("measured: {}\n", bounds.measured);
  return text;
}

} // namespace rung::wcet
