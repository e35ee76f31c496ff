// rungctl: shows and changes a program that runs in a host, through the host's socket (docs/control-protocol.md).
#include <algorithm>
#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <unistd.h>
#include <vector>

#include <nlohmann/json.hpp>

#include "machine/command-line/usage.h"
#include "machine/compile/compilation.h"
#include "machine/control/client.h"
#include "machine/control/log.h"
#include "machine/control/place.h"
#include "machine/rungctl/log.h"
#include "machine/rungctl/reload.h"
#include "machine/rungctl/rungc.h"
#include "machine/rungctl/status.h"
#include "machine/rungctl/top.h"
#include "machine/rungctl/trace.h"
#include "machine/rungctl/verify.h"
#include "machine/rungctl/words.h"

namespace {

using namespace rung;
using namespace rung::rungctl;
using control::writtenValue;
using nlohmann::json;

volatile int gStop = 0; // set by SIGINT and SIGTERM

int get(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "get"}, {"names", words.names}});
  std::string text;
  for (const std::string& name : words.names) text += fmt::format("{} = {}\n", name, shown(answer["values"][name]));
  print(words, answer, text);
  return cli::kOk;
}

// A watched name has no value after a program without that name has taken over.
std::string changeOf(const json& name, const json& value) {
  const std::string text = name["name"].get<std::string>();
  return value.is_null() ? text + " is gone" : text + " = " + shown(value);
}

int watch(Client& client, const Words& words) {
  const json begun = asked(client, {{"do", "watch"}, {"names", words.names}, {"all", words.all}});
  if (words.common.asJson) print(words, begun, "");
  json last = json::array();
  while (gStop == 0 && std::cout) {
    const std::optional<json> event = client.event(gStop);
    if (!event || event->value("event", "") != "values") continue;
    std::string text;
    for (size_t i = 0; i < words.names.size(); ++i)
      if (i >= last.size() || last[i] != (*event)["values"][i])
        text += fmt::format("{:.3f} {}\n", static_cast<double>(event->value("us", int64_t{0})) / 1e6,
                            changeOf(begun["names"][i], (*event)["values"][i]));
    last = (*event)["values"];
    print(words, *event, text);
  }
  return cli::kOk;
}

// Adds the scans that the host has completed but this process has not yet received, because a busy machine delays it.
void addRest(Client& client, const Words& words, rungctl::Trace& trace) {
  using std::chrono::milliseconds;
  // 0 if no scan ends any more
  const uint64_t newest = client.ask({{"do", "get"}, {"names", words.names}}).value("scan", uint64_t{0});
  const milliseconds patience(newest == 0 ? 0 : 2000);
  while (newest == 0 || trace.lastScan() < newest) {
    const std::optional<json> event = client.event(patience);
    if (!event) return;
    if (event->value("event", "") == "values") trace.add(*event);
  }
}

// Adds events until the time is over or the user interrupts. Events before a disconnection of the host are kept; its
// reason is returned.
std::string fill(Client& client, const Words& words, rungctl::Trace& trace) try {
  constexpr std::chrono::milliseconds kTurn(100); // short, so that the trace ends in time even without scans
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(words.seconds);
  while (gStop == 0 && (words.seconds == 0 || std::chrono::steady_clock::now() < end))
    if (const std::optional<json> event = client.event(kTurn); event && event->value("event", "") == "values")
      trace.add(*event);
  addRest(client, words, trace);
  return {};
} catch (const std::runtime_error& problem) {
  return gStop == 0 ? problem.what() : ""; // after a second interrupt the rest is not waited for
}

int trace(Client& client, const Words& words) {
  std::ofstream file(words.file, std::ios::binary);
  if (!file) return fail("cannot write " + words.file, cli::kEnvironment);
  const json begun = asked(client, {{"do", "watch"}, {"names", words.names}, {"all", true}});
  rungctl::Trace trace(file, client.greeting().value("program", ""), begun["names"]);
  file.flush(); // the header shows readers that recording has started
  const std::string problem = fill(client, words, trace);
  trace.end();
  if (!file.flush()) return fail("cannot write " + words.file, cli::kEnvironment);
  print(words, {{"ok", true}, {"scans", trace.scans()}},
        fmt::format("wrote {}: {} {}", words.file, trace.scans(), trace.scans() == 1 ? "scan" : "scans"));
  return problem.empty() ? int{cli::kOk} : fail(problem);
}

int set(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "set"}, {"name", words.name}, {"value", writtenValue(words.value)}});
  std::string text = fmt::format("{} = {} (was {})", words.name, shown(answer["value"]), shown(answer["former"]));
  if (answer.contains("note")) text += "\n" + answer["note"].get<std::string>();
  print(words, answer, text);
  return cli::kOk;
}

// NAME KEY=VALUE…: numbers become JSON numbers, everything else texts.
int event(Client& client, const Words& words) {
  json keys = json::object();
  for (const std::string& word : words.names) {
    const size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0)
      return fail("event: found " + word + ", expected KEY=VALUE", cli::kUsage);
    const json value = writtenValue(word.substr(equals + 1));
    keys[word.substr(0, equals)] = value.is_number() ? value : json(word.substr(equals + 1));
  }
  print(words, asked(client, {{"do", "event"}, {"name", words.name}, {"keys", keys}}), "done");
  return cli::kOk;
}

// The host may first have to compile code.
constexpr std::chrono::seconds kForce(compile::Compilation::kMostSeconds + 10);

int force(Client& client, const Words& words) {
  const json answer =
      asked(client, {{"do", "force"}, {"name", words.name}, {"value", writtenValue(words.value)}}, kForce);
  print(words, answer, fmt::format("{} is forced to {}", words.name, shown(answer["value"])));
  return cli::kOk;
}

int unforce(Client& client, const Words& words) {
  if (words.all == !words.name.empty()) return fail("unforce: expected a NAME or --all", cli::kUsage);
  json request = {{"do", "unforce"}, {"all", words.all}};
  if (!words.all) request["name"] = words.name;
  const json answer = asked(client, request, kForce);
  std::string text;
  for (const json& name : answer["names"]) text += shown(name) + " is no longer forced\n";
  print(words, answer, text.empty() ? "nothing was forced" : text);
  return cli::kOk;
}

int forced(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "forced"}});
  std::string text;
  for (const json& force : answer["forced"])
    text += fmt::format("{} = {}, by {}, since program time {:.3f} s\n", shown(force["name"]), shown(force["value"]),
                        shown(force["owner"]), static_cast<double>(force.value("since_us", int64_t{0})) / 1e6);
  print(words, answer, text.empty() ? "nothing is forced" : text);
  return cli::kOk;
}

int simple(Client& client, const Words& words, const char* command, const char* text) {
  print(words, asked(client, {{"do", command}}), text);
  return cli::kOk;
}

// Prints each pin with its value and its uses.
int map(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "map"}});
  std::string text;
  size_t width = 0;
  const auto pinOf = [](const json& pin) {
    return shown(pin["name"]) + (pin.contains("value") ? " = " + shown(pin["value"]) : "") +
           (pin.value("overwritten", false) ? ", overwritten" : "");
  };
  for (const json& pin : answer["pins"]) width = std::max(width, pinOf(pin).size());
  for (const json& pin : answer["pins"]) {
    std::vector<std::string> uses;
    for (const json& use : pin["uses"]) uses.push_back(shown(use));
    text += fmt::format("{:<5} {:<5} {:<{}}  {} ({}:{})\n", shown(pin["table"]), shown(pin["type"]), pinOf(pin), width,
                        fmt::join(uses, ", "), shown(pin["file"]), pin["line"].dump());
  }
  print(words, answer, text.empty() ? "the mapping file has no pins" : text);
  return cli::kOk;
}

std::string placeOf(const json& rung) {
  const std::string title = shown(rung["title"]);
  const std::string file = shown(rung["file"]);
  const std::string place = fmt::format("{}:{}", file, rung["line"].dump());
  return title.empty() ? place : place + "  " + title;
}

std::string profileText(const json& answer) {
  const double whole = answer["time_ns"].get<double>();
  std::string text = "  rung  executions   share    mean ns     max ns  place\n";
  for (const json& rung : answer["rungs"]) {
    const double time = rung["time_ns"].get<double>();
    const auto executions = rung["executions"].get<uint64_t>();
    text += fmt::format("{:>6} {:>11} {:>6.1f}% {:>10.1f} {:>10.1f}  {}\n", rung["rung"].dump(), executions,
                        whole > 0 ? 100 * time / whole : 0, time / static_cast<double>(executions),
                        rung["max_ns"].get<double>(), placeOf(rung));
  }
  const size_t ran = answer["ran"].get<size_t>();
  if (ran > answer["rungs"].size()) text += fmt::format("  ... and {} more\n", ran - answer["rungs"].size());
  if (const double outside = answer["outside_ns"].get<double>(); outside > 0)
    text += fmt::format(
        "     - {:>11} {:>6.1f}% {:>10} {:>10}  outside of the rungs: clock of timers, starts and ends of modules\n",
        "", 100 * outside / whole, "", "");
  return text + fmt::format("{} of {} rungs have run\n", ran, answer["count"].dump());
}

int profile(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "profile"}, {"top", words.top}, {"by", words.by}});
  if (words.reset) asked(client, {{"do", "clear-profile"}});
  print(words, answer, profileText(answer) + (words.reset ? "the counters start again from 0\n" : ""));
  return cli::kOk;
}

int serve(Client& client, const Words& words) {
  json request = {{"do", "serve"}};
  constexpr double kMsInS = 1000;
  if (words.seconds > 0) request["alive_ms"] = static_cast<unsigned>(words.seconds * kMsInS);
  std::cout << asked(client, request).dump() << std::endl;
  control::relay(client.connection(), STDIN_FILENO, std::cout, gStop);
  return cli::kOk;
}

int hosts(const Words& words) try {
  const std::vector<std::string> names = control::hostsOf(geteuid());
  std::string text;
  for (const std::string& name : names) text += name + "\n";
  print(words, json(names), text.empty() ? "no host is running" : text);
  return cli::kOk;
} catch (const std::exception& problem) {
  return fail(problem.what());
}

// A command: its options, and its function, which uses a connection to the host.
struct Row {
  const char* name;
  const char* description;
  void (*options)(cli::Command&, Words&); // null: none
  int (*run)(Client&, const Words&);      // null: always `alone`
  int (*alone)(const Words&) = nullptr;   // without a connection: if `run` is null, or there is a FILE
};

void namesOption(cli::Command& command, Words& words) {
  command.option("NAME", words.names, "Variables: names or addresses of the program").required();
}

void valueOptions(cli::Command& command, Words& words) {
  command.option("NAME", words.name, "Variable: a name or an address of the program").required();
  command.option("VALUE", words.value, "on, off, true, false or a number; also 0x1F").required();
}

void reloadOptions(cli::Command& command, Words& words) {
  command
      .option("FILE", words.files,
              "Compiled program (.so), or source files in order, or a project folder, which the host compiles")
      .required();
  command.flag("--profile", words.profile, "With sources: count and time every rung");
  command
      .option("--shadow", words.shadow,
              "First run it as a shadow beside the running program for this many scans, and compare outputs")
      .between(1u, 100000u);
  command.flag("--yes", words.yes, "Reload even if state is lost or outputs differ");
  command.flag("--late", words.late, "Reload even if a slice may take longer than its period");
}

int mark(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "mark"}, {"text", words.value}});
  print(words, answer, "marked\n");
  return cli::kOk;
}

int recording(Client& client, const Words& words) {
  if (words.all) asked(client, {{"do", "keep"}});
  const json answer = asked(client, {{"do", "recording"}});
  constexpr double kMega = 1e6;
  std::string text = fmt::format("folder {}, since {}, {:.1f} MB\n", shown(answer["folder"]),
                                 control::dateText(answer.value("since", int64_t{0})),
                                 static_cast<double>(answer.value("bytes", uint64_t{0})) / kMega);
  if (const auto losses = answer.value("losses", uint64_t{0}); losses != 0)
    text += fmt::format("{} {} since the start of the host\n", losses, losses == 1 ? "gap" : "gaps");
  if (answer.contains("problem")) text += "nothing is recorded now: " + shown(answer["problem"]) + "\n";
  if (words.all) text += "the present files are kept\n";
  print(words, answer, text);
  return cli::kOk;
}

constexpr Row kCommands[] = {
    {"status", "Show whether the program runs, its scans, its faults, and functions that wait", nullptr, status},
    {"messages", "Show messages of the program with their times, and faults and restarts",
     [](cli::Command& command, Words& words) {
       command.flag("-f,--follow", words.follow, "Keep printing new messages until Ctrl+C");
       command.flag("--on", words.on, "Show only messages that are on now");
       command.flag("--history", words.all, "Include messages from before the start of the host, up to 1000");
       command.flag("--acknowledge", words.acknowledge, "Note in the log that you have seen those that are on");
     },
     [](Client& client, const Words& words) { return messages(client, words, gStop); }},
    {"log", "Show what happened: messages, faults, changes by people; kept on disk across restarts",
     [](cli::Command& command, Words& words) {
       command.option("FILE", words.file, "A log on disk, FILE.log; default: the log of the running host");
       command.option("-n,--lines", words.most, "Number of entries, the last ones; default: 50, or all with --since")
           .between(uint64_t{1}, uint64_t{1'000'000});
       command.option("--since", words.since,
                      "Entries since \"2026-11-29\", \"2026-11-29 14:38\", 14:38 today, or 90s, 10m, 2h, 3d ago");
       command.option("--kind", words.kinds, "Only entries of this kind; may be repeated")
           .oneOf({std::begin(control::kLogKinds), std::end(control::kLogKinds)})
           .oneValue();
       command.flag("-f,--follow", words.follow, "Keep printing new entries until Ctrl+C");
     },
     [](Client& client, const Words& words) { return log(client, words, gStop); }, logFile},
    {"verify", "Say whether the machine runs this program, and which rungs differ",
     [](cli::Command& command, Words& words) {
       command.option("FILE", words.files, "Compiled program (.so), or source files in order, or a project folder")
           .required();
     },
     nullptr, verify},
    {"top", "Show scan times, costly rungs, timers, changed pins, messages and what waits, once a second",
     [](cli::Command& command, Words& words) { command.flag("--once", words.once, "Print all of it once, as text"); },
     nullptr, [](const Words& words) { return top(words, gStop); }},
    {"web", "Show the program in a browser: its rungs with power flow and values, its past, and why; by rungc",
     [](cli::Command& command, Words& words) {
       command.option("FILE", words.files,
                      "Sources of the program, or the folder of its project; default: the files that it names");
       command.option("--listen", words.listen,
                      "Address of the page, such as 8080 or 192.168.0.5:8080; default: a free port of this computer");
     },
     web},
    {"why", "Say why a variable has its value: the rungs and inputs that lead to it; by rungc",
     [](cli::Command& command, Words& words) {
       command.option("NAME", words.name, "Variable; or NAME@TIME, such as LAMP@12.5s of the program's clock")
           .required();
     },
     why},
    {"get", "Show values at the end of a scan", namesOption, get},
    {"watch", "Show values whenever they change, until Ctrl+C",
     [](cli::Command& command, Words& words) {
       namesOption(command, words);
       command.flag("--all", words.all, "Show every scan, instead of about 50 a second");
     },
     watch},
    {"trace", "Record values of every scan in a VCD file for wave viewers",
     [](cli::Command& command, Words& words) {
       namesOption(command, words);
       command.option("-o,--output", words.file, "File to write, FILE.vcd").required();
       command.option("--for", words.seconds, "Seconds to record; default: until Ctrl+C").between(0.001, 1e6);
     },
     trace},
    {"set", "Write a value to a variable once", valueOptions, set},
    {"mark", "Write a text into the recording of the program, and keep its present files",
     [](cli::Command& command, Words& words) { command.option("TEXT", words.value, "The text").required(); }, mark},
    {"recording", "Show where the program is recorded, since when, and what was lost",
     [](cli::Command& command, Words& words) { command.flag("--keep", words.all, "Keep the present files"); },
     recording},
    {"event", "Trigger an event of the control that rung-run simulates",
     [](cli::Command& command, Words& words) {
       command.option("NAME", words.name, "Name of the event, as in scenarios").required();
       command.option("KEY=VALUE", words.names, "Parameters of the event");
     },
     event},
    {"force", "Force a variable to a value", valueOptions, force},
    {"unforce", "Release a forced variable",
     [](cli::Command& command, Words& words) {
       command.option("NAME", words.name, "Variable to release, by the name under which it was forced");
       command.flag("--all", words.all, "Release all forced variables");
     },
     unforce},
    {"forced", "List forced variables", nullptr, forced},
    {"reload", "Replace the running program between two scans", reloadOptions,
     [](Client& client, const Words& words) { return reload(client, words, gStop); }},
    {"rollback", "Return to the program before the last reload; a second rollback returns to the reloaded one", nullptr,
     rollback},
    {"stop", "Stop the program; its outputs stay as they are", nullptr,
     [](Client& client, const Words& words) { return simple(client, words, "stop", "stopped"); }},
    {"start", "Continue a stopped program", nullptr,
     [](Client& client, const Words& words) { return simple(client, words, "start", "running"); }},
    {"reset", "Restart the program after a fault", nullptr,
     [](Client& client, const Words& words) { return simple(client, words, "reset", "restarted"); }},
    {"map", "Show the pins of the mapping file with their values", nullptr, map},
    {"profile", "Show the time of each rung of a program built with --profile",
     [](cli::Command& command, Words& words) {
       command.option("--by", words.by, "Sort rungs by total time or by longest execution")
           .oneOf({"time", "longest"})
           .showDefault();
       command.option("--top", words.top, "Number of rungs to show").between(1u, 10000u).showDefault();
       command.flag("--reset", words.reset, "Reset the counters afterwards");
     },
     profile},
    {"serve", "Answer the program's requests to its CNC: protocol lines on standard input and output",
     [](cli::Command& command, Words& words) {
       command
           .option("--alive", words.seconds, "Seconds of silence after which the host considers this connection dead")
           .between(0.1, 60.0);
     },
     serve},
};

class Commands {
public:
  Commands(cli::CommandLine& app, int& status) : app_(app), status_(status) { addCommon(app.root(), before_); }

  void add(const Row& row) {
    cli::Command command = app_.add(row.name, row.description);
    auto taken = std::make_shared<Words>();
    if (row.options != nullptr) row.options(command, *taken);
    addCommon(command, taken->common);
    command.onRun([this, taken, run = row.run, alone = row.alone] {
      taken->common.asJson = taken->common.asJson || before_.asJson;
      if (taken->common.host.empty()) taken->common.host = before_.host;
      status_ = begin(*taken, run, alone);
    });
  }
  void addHosts() {
    cli::Command command = app_.add("hosts", "List running hosts");
    auto taken = std::make_shared<Words>();
    command.flag("--json", taken->common.asJson, "Print the list as JSON");
    command.onRun([this, taken] {
      taken->common.asJson = taken->common.asJson || before_.asJson;
      status_ = hosts(*taken);
    });
  }

private:
  static void addCommon(cli::Command command, Common& common) {
    command.option("--host", common.host, "Name of the host; default: the only running one");
    command.flag("--json", common.asJson, "Print the answer as JSON");
  }
  static int begin(const Words& words, int (*run)(Client&, const Words&), int (*alone)(const Words&)) try {
    if (alone != nullptr && (run == nullptr || !words.file.empty())) return alone(words);
    Client client(words.common.host);
    return run(client, words);
  } catch (const std::exception& problem) {
    return fail(problem.what());
  }

  cli::CommandLine& app_;
  int& status_;
  Common before_; // common options before the command
};

} // namespace

int main(int argc, char** argv) {
  struct sigaction action{};
  action.sa_handler = [](int) { gStop = 1; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  cli::CommandLine app({.name = "rungctl",
                        .description = "Monitor and change a PLC program running in LinuxCNC or rung-run",
                        .exitStatus = "0 ok, 1 the host refuses or is not running, 2 wrong usage, 3 a file cannot be "
                                      "read or written; of verify: 0 "
                                      "the machine runs this program, 1 it does not, 2 unknown",
                        .guide = "docs/rungctl.md",
                        .seeAlso = {"rung-run(1)", "rung_hal(9)", "rungc(1)"}});
  int status = cli::kOk;
  Commands commands(app, status);
  commands.addHosts();
  for (const Row& row : kCommands) commands.add(row);
  cli::addUsage(app, status);
  const std::optional<int> decided = app.run(argc, argv, [&app](const cli::WrongWords& words) {
    std::cerr << cli::wrongUsage(app, words);
    return cli::kUsage;
  });
  return decided.value_or(status);
}
