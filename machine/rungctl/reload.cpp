// See reload.h.
#include "machine/rungctl/reload.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "machine/rung-compile/collect.h"

namespace rung::rungctl {

using nlohmann::json;

namespace {

std::string_view noteOf(const std::string& kind) {
  if (kind == "cut") return ": its new place has no room for all its contents, the rest is lost";
  if (kind == "released") return ": no rung writes it any more, it becomes 0";
  return "";
}

std::string reportOf(const json& answer) {
  std::string text;
  for (const json& rung : answer.value("rungs", json::array())) text += rungLine(rung) + "\n";
  for (const json& change : answer.value("changes", json::array()))
    text += fmt::format("{} {}{}{}\n", shown(change["kind"]), shown(change["name"]),
                        change.value("former", "").empty() ? "" : " (was " + shown(change["former"]) + ")",
                        noteOf(change.value("kind", "")));
  for (const json& pin : answer.value("pins", json::array())) text += shown(pin) + "\n";
  text += fmt::format("kept: {} names, {} states of edges, timers and counters\n", answer.value("kept_cells", 0),
                      answer.value("kept_states", 0));
  const json ended = answer.value("ended_forces", json::array());
  std::vector<std::string> names;
  for (const json& name : ended) names.push_back(shown(name));
  if (!names.empty())
    text +=
        fmt::format("{} {} ended: {}\n", names.size(), names.size() == 1 ? "force" : "forces", fmt::join(names, ", "));
  return text;
}

std::string stateOf(const json& report) {
  const std::string state = report["state"];
  return state == "too-slow" ? "ended, too slow" : state;
}

// Runs the new program as a shadow until it has been compared. Returns "", or the reason why it does not take over.
std::string whatSpeaksAgainst(Client& client, const Words& words, const volatile int& stop, json request) {
  request["do"] = "shadow";
  request["scans"] = words.shadow;
  asked(client, request);
  json report;
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    report = asked(client, {{"do", "compared"}});
  } while (stop == 0 && (report["state"] == "running" || report["state"] == "prepared"));
  const size_t differences = report["differences"].size();
  std::string text =
      fmt::format("shadow run {}: {} task runs compared, {}\n", stateOf(report), report["runs"].dump(),
                  differences == 0 ? "no difference" : fmt::format("outputs that differ: {}", differences));
  for (const json& difference : report["differences"])
    text += difference.contains("next")
                ? fmt::format("{}: {} now, {} in the new program\n", shown(difference["name"]),
                              shown(difference["running"]), shown(difference["next"]))
                : fmt::format("{}: requested only by the new program\n", shown(difference["name"]));
  if (!report.value("fault", "").empty()) text += shown(report["fault"]) + "\n";
  print(words, report, text);
  if (!report.value("fault", "").empty())
    throw std::runtime_error("the new program stopped with a fault during the comparison; nothing has changed");
  if (!report["differences"].empty()) return "the new program behaves differently";
  if (report["state"] == "too-slow") return "this host is too slow to run both programs: not all scans were compared";
  if (report["state"] != "finished") return "the comparison was not finished";
  return report["runs"] == 0 ? "no run of a task was compared" : "";
}

// Prints the errors of the sources, like rungc.
int failSources(const Words& words, const std::string& report, const std::string& diagnostics = "",
                int status = cli::kWrong) {
  if (words.common.asJson) {
    json answer = {{"ok", false}, {"error", report}};
    if (!diagnostics.empty()) answer["diagnostics"] = json::parse(diagnostics);
    std::cout << answer.dump(-1, ' ', false, json::error_handler_t::replace) << '\n';
  } else if (!report.empty()) {
    std::cerr << report << (report.ends_with('\n') ? "" : "\n");
  }
  return fail("nothing has changed", status);
}

// Lets the host compile the sources. Returns kOk, or another status after printing the errors.
int compileThere(Client& client, const Words& words, const volatile int& stop) {
  rung_compile::Collected collected = rung_compile::collect(words.files, isatty(STDERR_FILENO) != 0);
  if (!collected.sources)
    return failSources(words, collected.report, collected.diagnostics,
                       collected.unreadable ? cli::kEnvironment : cli::kWrong);
  collected.sources->profile = words.profile;
  const json answer = control::compiledByHost(client, packed(*collected.sources), stop);
  const std::string report = answer.value("report", "");
  if (answer["state"] != "compiled") return failSources(words, report);
  if (!words.common.asJson) std::cerr << report; // warnings
  return cli::kOk;
}

// Sets the program in the request. Returns kOk, or another status if there is none.
int programOf(Client& client, const Words& words, const volatile int& stop, json& request) {
  const bool compiled = std::ranges::any_of(words.files, [](const std::string& file) { return file.ends_with(".so"); });
  if (compiled && words.files.size() > 1)
    return fail("found a compiled program together with other files, expected one compiled program, or only sources",
                cli::kUsage);
  if (compiled && words.profile)
    return fail("--profile is only for sources; build a compiled program with `rungc build --profile`", cli::kUsage);
  if (compiled) {
    const std::unique_ptr<char, decltype(&std::free)> path(realpath(words.files.front().c_str(), nullptr), &std::free);
    if (path == nullptr) return fail("there is no file " + words.files.front(), cli::kEnvironment);
    request["program"] = path.get();
    return cli::kOk;
  }
  request["compiled"] = true;
  return compileThere(client, words, stop);
}

} // namespace

std::string rungLine(const json& rung) {
  const std::string title = rung.value("title", "");
  return fmt::format("{} rung {}{}, {}:{}", shown(rung["kind"]), shown(rung["rung"]),
                     title.empty() ? "" : " \"" + title + "\"", shown(rung["file"]), shown(rung["line"]));
}

int reload(Client& client, const Words& words, const volatile int& stop) {
  json request = json::object();
  if (const int status = programOf(client, words, stop, request); status != cli::kOk) return status;
  if (words.shadow != 0) {
    if (const std::string against = whatSpeaksAgainst(client, words, stop, request); !against.empty() && !words.yes)
      return fail(against + "; nothing has changed; use --yes to replace it anyway");
    if (stop != 0) return fail("interrupted; nothing has changed");
  }
  request.update({{"do", "reload"}, {"yes", words.yes}, {"late", words.late}});
  const json answer = client.ask(request);
  if (answer.value("ok", false)) {
    print(words, answer, reportOf(answer) + control::whetherItRuns(answer, "new"));
    return answer.value("put_back", false) ? cli::kWrong : cli::kOk;
  }
  if (words.common.asJson) std::cout << answer.dump() << '\n';
  if (answer.contains("needs")) {
    if (!words.common.asJson) std::cout << reportOf(answer);
    return fail(answer.value("error", "") + "; nothing has changed; use --yes to do it anyway");
  }
  return fail(answer.value("error", "the host refuses"));
}

int rollback(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "rollback"}});
  print(words, answer,
        reportOf(answer) + control::whetherItRuns(answer, answer.value("again", false) ? "reloaded" : "former"));
  return cli::kOk;
}

} // namespace rung::rungctl
