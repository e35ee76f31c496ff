// rungctl: looks at and changes a program that runs in a host, by the host's socket (docs/control-protocol.md).
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <unistd.h>
#include <vector>

#include <nlohmann/json.hpp>

#include "tools/command-line/usage.h"
#include "tools/remote/place.h"
#include "tools/rungctl/client.h"
#include "tools/rungctl/relay.h"
#include "tools/rungctl/reload.h"
#include "tools/rungctl/trace.h"
#include "tools/rungctl/words.h"
#include "tools/sources/compilation.h"

namespace {

using namespace rung;
using namespace rung::rungctl;
using nlohmann::json;

volatile int gStop = 0; // of SIGINT and SIGTERM

// A number, true or false; anything else stays a text, which the host refuses with what it expected.
json valueOf(const std::string& text) {
  if (text.starts_with("0x") || text.starts_with("0X")) { // JSON has none
    char* end = nullptr;
    const unsigned long long number = std::strtoull(text.c_str(), &end, 16);
    if (*end == '\0') return number;
  }
  json value = json::parse(text, nullptr, false);
  return value.is_discarded() || value.is_structured() ? json(text) : value;
}

// What rung-run adds: its clock and its connections.
std::string clockOf(const json& answer) {
  if (!answer.contains("clock")) return {};
  const json& clock = answer["clock"];
  const auto figure = [&](const char* key) { return clock.value(key, 0.0); };
  std::string text =
      fmt::format("every {:.0f} us: {} steps, {} overruns, from step to step {:.1f} to {:.1f} us\n"
                  "start late: 99% within {:.1f} us, 99.9% within {:.1f} us, the latest {:.1f} us\n"
                  "a step took {:.1f} us on average; the longest:",
                  figure("period_us"), clock.value("steps", uint64_t{0}), clock.value("overruns", uint64_t{0}),
                  figure("shortest_period_us"), figure("longest_period_us"), figure("late_99_us"),
                  figure("late_999_us"), figure("latest_us"), figure("mean_us"));
  for (const json& step : clock.value("worst", json::array()))
    text += fmt::format(" {:.1f} us (at {:.3f} s)", step.value("us", 0.0), step.value("at_s", 0.0));
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
  return fmt::format("stopped by a fault{}: {}\n{}", faulty.empty() ? "" : " of " + faulty + ", which ran then", fault,
                     problem.empty() ? "" : "the last restart has failed: " + problem + "\n");
}

int status(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "status"}});
  std::string text = fmt::format("host {}, program {}, dialect {}\n", shown(answer["host"]), shown(answer["program"]),
                                 shown(answer["dialect"]));
  if (answer.value("powered_off", false))
    text += "switched off: the program has had its regular end\n";
  else if (!answer.value("scanned", false))
    text += "nobody scans it: the host's thread does not run\n";
  else if (answer.value("faulted", false))
    text += stopOf(answer);
  else
    text += fmt::format("{}: {} passes, {} missed, {:.3f} s of its time{}\n",
                        answer.value("stopped", false) ? "stopped by the operator" : "running",
                        answer.value("passes", uint64_t{0}), answer.value("missed", uint64_t{0}),
                        static_cast<double>(answer.value("us", int64_t{0})) / 1e6,
                        answer.value("unsaved", false) ? "; the retained memory cannot be written" : "");
  print(words, answer, text + clockOf(answer) + connectionsOf(answer));
  return cli::kOk;
}

int messages(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "messages"}, {"follow", words.follow}});
  std::string text;
  for (const json& message : answer["messages"]) text += shown(message) + "\n";
  print(words, answer, text);
  while (words.follow && gStop == 0)
    if (const std::optional<json> event = client.event(gStop)) print(words, *event, shown((*event)["text"]));
  return cli::kOk;
}

int get(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "get"}, {"names", words.names}});
  std::string text;
  for (const std::string& name : words.names) text += fmt::format("{} = {}\n", name, shown(answer["values"][name]));
  print(words, answer, text);
  return cli::kOk;
}

// Of a watched name; one that is not a real has none after a program without that name has taken over.
std::string changeOf(const json& name, const json& value) {
  const std::string text = name["name"].get<std::string>();
  return value.is_null() && name["type"] != "real" ? text + " is gone" : text + " = " + shown(value);
}

int watch(Client& client, const Words& words) {
  const json begun = asked(client, {{"do", "watch"}, {"names", words.names}, {"all", words.all}});
  if (words.common.asJson) print(words, begun, "");
  json last = json::array();
  while (gStop == 0) {
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

// What the program has done until now and has not arrived yet: a busy machine lets this process wait.
void addRest(Client& client, const Words& words, rungctl::Trace& trace) {
  using std::chrono::milliseconds;
  // 0 where no pass ends any more.
  const uint64_t newest = client.ask({{"do", "get"}, {"names", words.names}}).value("pass", uint64_t{0});
  const milliseconds patience(newest == 0 ? 0 : 2000);
  while (newest == 0 || trace.lastPass() < newest) {
    const std::optional<json> event = client.event(patience);
    if (!event) return;
    if (event->value("event", "") == "values") trace.add(*event);
  }
}

int trace(Client& client, const Words& words) {
  std::ofstream file(words.file, std::ios::binary);
  if (!file) return fail("cannot write " + words.file, cli::kEnvironment);
  const json begun = asked(client, {{"do", "watch"}, {"names", words.names}, {"all", true}});
  rungctl::Trace trace(file, client.greeting().value("program", ""), begun["names"]);
  file.flush();                                   // its head shows a reader that no pass is missed from now on
  constexpr std::chrono::milliseconds kTurn(100); // it ends in time where no pass comes, too
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(words.seconds);
  while (gStop == 0 && (words.seconds == 0 || std::chrono::steady_clock::now() < end))
    if (const std::optional<json> event = client.event(kTurn); event && event->value("event", "") == "values")
      trace.add(*event);
  addRest(client, words, trace);
  trace.end();
  if (!file.flush()) return fail("cannot write " + words.file, cli::kEnvironment);
  print(words, {{"ok", true}, {"passes", trace.passes()}},
        fmt::format("wrote {}: {} {}", words.file, trace.passes(), trace.passes() == 1 ? "pass" : "passes"));
  return cli::kOk;
}

int set(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "set"}, {"name", words.name}, {"value", valueOf(words.value)}});
  std::string text = fmt::format("{} = {}, before {}", words.name, shown(answer["value"]), shown(answer["former"]));
  if (answer.contains("note")) text += "\n" + answer["note"].get<std::string>();
  print(words, answer, text);
  return cli::kOk;
}

// NAME KEY=VALUE…: numbers are numbers, all else is text.
int event(Client& client, const Words& words) {
  json keys = json::object();
  for (const std::string& word : words.names) {
    const size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0)
      return fail("event: found " + word + ", expected KEY=VALUE", cli::kUsage);
    const json value = valueOf(word.substr(equals + 1));
    keys[word.substr(0, equals)] = value.is_number() ? value : json(word.substr(equals + 1));
  }
  print(words, asked(client, {{"do", "event"}, {"name", words.name}, {"keys", keys}}), "done");
  return cli::kOk;
}

// The host may have to make code first.
constexpr std::chrono::seconds kForce(sources::Compilation::kMostSeconds + 10);

int force(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "force"}, {"name", words.name}, {"value", valueOf(words.value)}}, kForce);
  print(words, answer, fmt::format("{} is forced to {}", words.name, shown(answer["value"])));
  return cli::kOk;
}

int unforce(Client& client, const Words& words) {
  if (words.all == !words.name.empty()) return fail("unforce: expected a NAME or --all", cli::kUsage);
  json request = {{"do", "unforce"}, {"all", words.all}};
  if (!words.all) request["name"] = words.name;
  const json answer = asked(client, request, kForce);
  print(words, answer, fmt::format("{} ended", answer["ended"].dump()));
  return cli::kOk;
}

int forced(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "forced"}});
  std::string text;
  for (const json& force : answer["forced"])
    text += fmt::format("{} = {}, by {}\n", shown(force["name"]), shown(force["value"]), shown(force["owner"]));
  print(words, answer, text.empty() ? "nothing is forced" : text);
  return cli::kOk;
}

int simple(Client& client, const Words& words, const char* command, const char* text) {
  print(words, asked(client, {{"do", command}}), text);
  return cli::kOk;
}

int map(Client& client, const Words& words) {
  const json answer = asked(client, {{"do", "map"}});
  std::string text;
  for (const json& pin : answer["pins"])
    text += fmt::format("{:<5} {:<5} {} ({}:{})\n", shown(pin["table"]), shown(pin["type"]), shown(pin["name"]),
                        shown(pin["file"]), pin["line"].dump());
  print(words, answer, text);
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
  print(words, answer, profileText(answer) + (words.reset ? "from now on they are counted anew\n" : ""));
  return cli::kOk;
}

int serve(Client& client, const Words& words) {
  json request = {{"do", "serve"}};
  constexpr double kMsInS = 1000;
  if (words.seconds > 0) request["alive_ms"] = static_cast<unsigned>(words.seconds * kMsInS);
  std::cout << asked(client, request).dump() << std::endl;
  rungctl::relay(client.connection(), STDIN_FILENO, std::cout, gStop);
  return cli::kOk;
}

int hosts(const Words& words) try {
  const std::vector<std::string> names = remote::hostsOf(geteuid());
  std::string text;
  for (const std::string& name : names) text += name + "\n";
  print(words, json(names), text.empty() ? "no host is running" : text);
  return cli::kOk;
} catch (const std::exception& problem) {
  return fail(problem.what());
}

class Commands {
public:
  Commands(cli::CommandLine& app, int& status) : app_(app), status_(status) { addCommon(app.root(), before_); }

  using Run = std::function<int(Client&, const Words&)>;
  // Adds one; `words` gives it its own words.
  void add(const char* name, const char* description, const std::function<void(cli::Command&, Words&)>& words,
           Run run) {
    cli::Command command = app_.add(name, description);
    auto taken = std::make_shared<Words>();
    words(command, *taken);
    addCommon(command, taken->common);
    command.onRun([this, taken, run = std::move(run)] {
      taken->common.asJson = taken->common.asJson || before_.asJson;
      if (taken->common.host.empty()) taken->common.host = before_.host;
      status_ = begin(*taken, run);
    });
  }
  void addHosts() {
    cli::Command command = app_.add("hosts", "List the hosts that are running");
    auto taken = std::make_shared<Words>();
    command.flag("--json", taken->common.asJson, "As JSON");
    command.onRun([this, taken] {
      taken->common.asJson = taken->common.asJson || before_.asJson;
      status_ = hosts(*taken);
    });
  }

private:
  static void addCommon(cli::Command command, Common& common) {
    command.option("--host", common.host, "The name of the host; without it the only one that is running");
    command.flag("--json", common.asJson, "The answer as JSON");
  }
  static int begin(const Words& words, const Run& run) try {
    Client client(words.common.host);
    return run(client, words);
  } catch (const std::exception& problem) {
    return fail(problem.what());
  }

  cli::CommandLine& app_;
  int& status_;
  Common before_; // the command
};

// NOLINTNEXTLINE(readability-function-size): a command after the other
void addAll(Commands& commands) {
  const auto none = [](cli::Command&, Words&) {};
  const auto names = [](cli::Command& command, Words& words) {
    command.option("NAME", words.names, "Names or addresses of the program").required();
  };
  const auto oneValue = [](cli::Command& command, Words& words) {
    command.option("NAME", words.name, "A name or an address of the program").required();
    command.option("VALUE", words.value, "true, false or a number").required();
  };
  commands.addHosts();
  commands.add("status", "Say what the program does", none, status);
  commands.add(
      "messages", "Show what the program and its host have reported",
      [](cli::Command& command, Words& words) {
        command.flag("-f,--follow", words.follow, "And what they report from now on");
      },
      messages);
  commands.add("get", "Show values at the end of a pass", names, get);
  commands.add(
      "watch", "Show values whenever they change",
      [&](cli::Command& command, Words& words) {
        names(command, words);
        command.flag("--all", words.all, "Look at every pass, not at a few a second");
      },
      watch);
  commands.add(
      "trace", "Write the values of every pass to a file for wave viewers",
      [&](cli::Command& command, Words& words) {
        names(command, words);
        command.option("-o,--output", words.file, "The file, FILE.vcd").required();
        command.option("--for", words.seconds, "Seconds; without it until Ctrl+C").between(0.001, 1e6);
      },
      trace);
  commands.add("set", "Write a value into a cell, once", oneValue, set);
  commands.add(
      "event", "Do something at the simulated control of rung-run",
      [](cli::Command& command, Words& words) {
        command.option("NAME", words.name, "The event, as in scenarios").required();
        command.option("KEY=VALUE", words.names, "What belongs to it");
      },
      event);
  commands.add("force", "Hold a cell at a value", oneValue, force);
  commands.add(
      "unforce", "Let go of a cell that is forced",
      [](cli::Command& command, Words& words) {
        command.option("NAME", words.name, "The name that is forced");
        command.flag("--all", words.all, "All of them");
      },
      unforce);
  commands.add("forced", "List the cells that are forced", none, forced);
  commands.add(
      "reload", "Replace the program by another one, between two passes",
      [](cli::Command& command, Words& words) {
        command
            .option("FILE", words.files,
                    "The compiled program (.so); or its source files in order, or the folder of a project, which the "
                    "host compiles")
            .required();
        command.flag("--profile", words.profile, "Of sources: count and time every rung");
        command.option("--shadow", words.shadow, "First run it beside the other for so many passes, and compare")
            .between(1u, 100000u);
        command.flag("--yes", words.yes, "Also where state is lost or outputs differ");
        command.flag("--late", words.late, "Also where a slice of it may last longer than its period");
      },
      [](Client& client, const Words& words) { return reload(client, words, gStop); });
  commands.add("rollback", "Put back the program before the last reload", none, rollback);
  commands.add("stop", "Stop the program; its outputs stay as they are", none,
               [](Client& client, const Words& words) { return simple(client, words, "stop", "stopped"); });
  commands.add("start", "Let a stopped program run on", none,
               [](Client& client, const Words& words) { return simple(client, words, "start", "running"); });
  commands.add("reset", "Restart a program that a fault has stopped", none,
               [](Client& client, const Words& words) { return simple(client, words, "reset", "restarted"); });
  commands.add("map", "Show the pins of the mapping file", none, map);
  commands.add(
      "profile", "Show what the rungs of a program built with --profile cost",
      [](cli::Command& command, Words& words) {
        command.option("--by", words.by, "Order: all the time that a rung took, or its longest run")
            .oneOf({"time", "longest"})
            .showDefault();
        command.option("--top", words.top, "Rungs in the table").between(1u, 10000u).showDefault();
        command.flag("--reset", words.reset, "Then count and time anew");
      },
      profile);
  commands.add(
      "serve", "Answer what the program asks of its CNC: lines of the protocol on standard input and output",
      [](cli::Command& command, Words& words) {
        command
            .option("--alive", words.seconds, "Seconds of silence after which the host takes this connection for dead")
            .between(0.1, 60.0);
      },
      serve);
}

} // namespace

int main(int argc, char** argv) {
  struct sigaction action{};
  action.sa_handler = [](int) { gStop = 1; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  cli::CommandLine app(
      {.name = "rungctl",
       .description = "Looks at and changes a PLC program that runs in LinuxCNC or in rung-run",
       .exitStatus = "0 ok, 1 the host refuses or is not there, 2 wrong usage, 3 a file cannot be written or read",
       .guide = "docs/rungctl.md",
       .seeAlso = {"rung-run(1)", "rung_hal(9)", "rungc(1)"}});
  int status = cli::kOk;
  Commands commands(app, status);
  addAll(commands);
  cli::addUsage(app, status);
  const std::optional<int> decided = app.run(argc, argv, [&app](const cli::WrongWords& words) {
    std::cerr << cli::wrongUsage(app, words);
    return cli::kUsage;
  });
  return decided.value_or(status);
}
