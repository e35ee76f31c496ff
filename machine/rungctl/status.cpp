// See status.h.
#include "machine/rungctl/status.h"

#include <algorithm>
#include <ctime>
#include <fmt/format.h>
#include <iterator>

#include "machine/control/log.h"

namespace rung::rungctl {

using nlohmann::json;

namespace {

// The figures that rung-run adds: its clock and its connections.
std::string clockOf(const json& answer) {
  if (!answer.contains("clock")) return {};
  const json& clock = answer["clock"];
  const auto figure = [&](const char* key) { return clock.value(key, 0.0); };
  std::string text = fmt::format(
      "since the host started, every {:.0f} us: {} steps, {} overruns, from step to step {:.1f} to {:.1f} us\n"
      "start late: 99% within {:.1f} us, 99.9% within {:.1f} us, the latest {:.1f} us\n"
      "a step took {:.1f} us on average; the longest:",
      figure("period_us"), clock.value("steps", uint64_t{0}), clock.value("overruns", uint64_t{0}),
      figure("shortest_period_us"), figure("longest_period_us"), figure("late_99_us"), figure("late_999_us"),
      figure("latest_us"), figure("mean_us"));
  for (const json& step : clock.value("worst", json::array()))
    text += fmt::format("{} {:.1f} us (at {:.3f} s)", text.ends_with(')') ? "," : "", step.value("us", 0.0),
                        step.value("at_s", 0.0));
  return text + "\n";
}

std::string connectionsOf(const json& answer) {
  std::string text;
  for (const json& one : answer.value("connections", json::array())) {
    const std::string problem = one.value("problem", "");
    text += fmt::format("{}: {}, {} exchanges, lost {} times{}\n", shown(one["name"]),
                        one.value("alive", false) ? "connected" : "silent", one.value("exchanges", uint64_t{0}),
                        one.value("losses", uint64_t{0}), problem.empty() ? "" : "; the last problem: " + problem);
  }
  return text;
}

std::string stopOf(const json& answer) {
  const std::string fault = answer.value("fault", "");
  const std::string faulty = answer.value("fault_of", "");
  const std::string problem = answer.value("restart_problem", "");
  return fmt::format("stopped by a fault{}: {}\n{}", faulty.empty() ? "" : " of " + faulty + ", which was running then",
                     fault, problem.empty() ? "" : "the last restart has failed: " + problem + "\n");
}

// "for 12.345 s, since 14:38:04", with the date if it was not today.
std::string ageOf(const json& one) {
  constexpr size_t kDate = 11; // "2026-11-29 "
  std::string since = control::dateText(one.value("since", int64_t{0}));
  if (control::dateText(std::time(nullptr)).starts_with(since.substr(0, kDate))) since.erase(0, kDate);
  return fmt::format("for {:.3f} s, since {}", static_cast<double>(one.value("us", int64_t{0})) / 1e6, since);
}

// M, S and T functions in progress or queued: one line each, the oldest first.
std::vector<Waiting> functionsOf(const json& answer) {
  std::vector<Waiting> lines;
  const json functions = answer.value("functions", json::object());
  const json oldest = functions.value("oldest", json::array());
  for (const json& one : oldest) {
    const uint64_t channel = one.value("channel", uint64_t{1});
    const bool late = one.value("late", false);
    lines.push_back({fmt::format("{}{}{}: {} {}{}", shown(one["function"]), one["code"].dump(),
                                 channel == 1 ? "" : fmt::format(" in channel {}", channel),
                                 one.value("begun", false) ? "not finished by the program" : "waits for its turn",
                                 ageOf(one), late ? ", longer than the timeout of the mapping file" : ""),
                     late});
  }
  const auto count = functions.value("count", uint64_t{0});
  if (count > oldest.size()) lines.push_back({fmt::format("and {} more functions", count - oldest.size())});
  const auto lost = functions.value("lost", uint64_t{0});
  if (lost != 0) lines.push_back({fmt::format("functions lost since the host started: {}", lost)});
  return lines;
}

// "macro-variable 500", "axis-move of axis 1, jog".
std::string requestOf(const json& one) {
  const std::string quantity = one.value("quantity", "");
  const std::string channel = one.value("channel", 0) == 0 ? "" : fmt::format(" in channel {}", one["channel"].dump());
  if (quantity == "axis-move")
    return fmt::format("axis-move of axis {}, {}", one["axis"].dump(), one.value("motion", ""));
  return fmt::format("{} {}{}{}", quantity, one["number"].dump(), channel,
                     one.contains("value") ? " := " + one["value"].dump() : "");
}

// Requests of the program to its CNC: one line each, the oldest first.
std::vector<Waiting> requestsOf(const json& answer) {
  std::vector<Waiting> lines;
  const json requests = answer.value("requests", json::object());
  const json oldest = requests.value("oldest", json::array());
  for (const json& one : oldest)
    lines.push_back({fmt::format("{}: not answered by the CNC {}", requestOf(one), ageOf(one))});
  if (const auto count = requests.value("count", uint64_t{0}); count > oldest.size())
    lines.push_back({fmt::format("and {} more requests", count - oldest.size())});
  return lines;
}

std::string runningOf(const json& answer) {
  return fmt::format("{}: {} scans, {} missed{}; program time {:.3f} s{}\n",
                     answer.value("stopped", false) ? "stopped by the operator" : "running",
                     answer.value("scans", uint64_t{0}), answer.value("missed", uint64_t{0}),
                     answer.value("restarts", uint64_t{0}) != 0 ? " since the last reset" : "",
                     static_cast<double>(answer.value("us", int64_t{0})) / 1e6,
                     answer.value("unsaved", false) ? "; the retained memory cannot be written" : "");
}

} // namespace

std::string stateText(const json& answer) {
  if (answer.value("powered_off", false)) return "switched off: the program has ended regularly\n";
  if (answer.contains("not_run")) return "it does not run: " + shown(answer["not_run"]) + "\n";
  if (!answer.value("scanned", false)) return "not scanned: the thread of the host does not run\n";
  return answer.value("faulted", false) ? stopOf(answer) : runningOf(answer);
}

std::vector<Waiting> waitingOf(const json& status) {
  std::vector<Waiting> lines = functionsOf(status);
  std::ranges::move(requestsOf(status), std::back_inserter(lines));
  return lines;
}

int status(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "status"}});
  std::string text = fmt::format("host {}, program {}, dialect {}\n", shown(answer["host"]), shown(answer["program"]),
                                 shown(answer["dialect"])) +
                     stateText(answer);
  if (const auto forced = answer.value("forced", size_t{0}); forced != 0)
    text += fmt::format("{} forced: see rungctl forced\n", forced);
  for (const Waiting& waiting : waitingOf(answer)) text += waiting.text + "\n";
  print(words, answer, text + clockOf(answer) + connectionsOf(answer));
  return cli::kOk;
}

} // namespace rung::rungctl
