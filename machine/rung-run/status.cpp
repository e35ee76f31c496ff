// See status.h.
#include "machine/rung-run/status.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace rung::rung_run {
namespace {

double microseconds(int64_t ns) { return static_cast<double>(ns) / 1e3; }
double seconds(int64_t ns) { return static_cast<double>(ns) / 1e9; }

} // namespace

std::vector<std::string> report(const StepFigures& steps, const std::vector<io::Figures>& connections) {
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{} steps, {} overruns; from step to step {:.1f} to {:.1f} us", steps.steps,
                              steps.overruns, microseconds(steps.shortestPeriodNs),
                              microseconds(steps.longestPeriodNs)));
  lines.push_back(fmt::format("start late: 99% of the steps within {:.1f} us, 99.9% within {:.1f} us, the latest "
                              "{:.1f} us",
                              microseconds(steps.late99Ns), microseconds(steps.late999Ns),
                              microseconds(steps.latestNs)));
  std::string worst;
  for (const StepFigures::Worst& step : steps.worst)
    worst += fmt::format("{}{:.1f} us (at {:.3f} s)", worst.empty() ? "" : ", ", microseconds(step.tookNs),
                         seconds(step.beginNs));
  lines.push_back(fmt::format("a step took {:.1f} us on average; the longest: {}", microseconds(steps.meanNs), worst));
  for (const io::Figures& one : connections)
    lines.push_back(fmt::format("{}: {} exchanges, lost {} times{}", one.title, one.exchanges, one.losses,
                                one.problem.empty() ? "" : "; the last problem: " + one.problem));
  return lines;
}

void addStatus(nlohmann::json& status, int64_t periodNs, const StepFigures& steps,
               const std::vector<io::Figures>& connections) {
  nlohmann::json worst = nlohmann::json::array();
  for (const StepFigures::Worst& step : steps.worst)
    worst.push_back({{"us", microseconds(step.tookNs)}, {"at_s", seconds(step.beginNs)}});
  status["clock"] = {{"period_us", microseconds(periodNs)},
                     {"steps", steps.steps},
                     {"overruns", steps.overruns},
                     {"shortest_period_us", microseconds(steps.shortestPeriodNs)},
                     {"longest_period_us", microseconds(steps.longestPeriodNs)},
                     {"late_99_us", microseconds(steps.late99Ns)},
                     {"late_999_us", microseconds(steps.late999Ns)},
                     {"latest_us", microseconds(steps.latestNs)},
                     {"last_us", microseconds(steps.lastNs)},
                     {"mean_us", microseconds(steps.meanNs)},
                     {"took_50_us", microseconds(steps.took50Ns)},
                     {"took_99_us", microseconds(steps.took99Ns)},
                     {"took_999_us", microseconds(steps.took999Ns)},
                     {"worst", worst}};
  status["connections"] = nlohmann::json::array();
  for (const io::Figures& one : connections)
    status["connections"].push_back({{"name", one.title},
                                     {"alive", one.alive},
                                     {"exchanges", one.exchanges},
                                     {"losses", one.losses},
                                     {"problem", one.problem}});
}

} // namespace rung::rung_run
