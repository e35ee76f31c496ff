// rungc replay: goes through the past of a program, at a prompt or by options.
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/replay/console.h"
#include "tools/replay/growing_recording.h"
#include "tools/replay/past.h"
#include "tools/replay/record_run.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/host.h"
#include "tools/rungc/stop_signal.h"
#include "tools/rungc/web.h"
#include "tools/scenario/in_project.h"
#include "tools/scenario/prompt.h"

namespace rung::rungc {
namespace {

struct ReplayOptions {
  std::string file;
  std::string host;     // instead of the file
  SourceOptions source; // of the program, which the recording may lack
  std::optional<uint64_t> at;
  std::vector<std::string> show;
  std::string find;
  std::string why;
  std::string exported;
  std::optional<uint64_t> from, to;
  std::vector<std::string> watch;
  unsigned most = 100;
  bool json = false;
  bool web = false;
  std::string listen = kDefaultListen;
};

// A scenario is run and recorded in memory. On failure nothing, and `status` says why.
std::optional<replay::Recording> recordingOf(const std::string& file, int& status) {
  Result<scenario::Scenario> scenario = scenario::readScenario(file);
  if (!scenario.ok()) {
    status = environmentError(scenario.error());
    return std::nullopt;
  }
  scenario::takeProject(scenario.value());
  Result<replay::RecordedScenario> recorded =
      replay::recordScenario(scenario.value(), {.engines = {compiler::EngineKind::Interp}});
  if (!recorded.ok()) {
    status = environmentError(fmt::format("{}: {}", file, recorded.error()));
    return std::nullopt;
  }
  for (const scenario::Problem& problem : recorded.value().result.problems)
    fmt::print("{}\n", scenario::textOf(problem));
  return std::move(recorded.value().recording);
}

using Programs = std::vector<std::shared_ptr<const compiler::Compiled>>;

// The programs that the recording may lack. On failure nothing, and `status` says why.
std::optional<Programs> givenPrograms(const SourceOptions& source, int& status) {
  Programs known;
  if (source.files.empty()) return known;
  SourceManager sources;
  compiler::CompileRequest request;
  request.marks = request.keepBuilt = true;
  std::optional<compiler::Compiled> compiled = compileSources(sources, source, std::move(request), status);
  if (!compiled) return std::nullopt;
  known.push_back(std::make_shared<compiler::Compiled>(std::move(*compiled)));
  return known;
}

void printProblems(const replay::Recording& recording) {
  for (const std::string& problem : recording.problems) fmt::print(stderr, "rungc: {}\n", problem);
  for (const replay::Segment& segment : recording.segments)
    if (!segment.damage.empty()) fmt::print(stderr, "rungc: {}\n", segment.damage);
}

std::optional<replay::Recording> openRecording(const ReplayOptions& options, int& status) {
  if (options.file.ends_with(".scn")) return recordingOf(options.file, status);
  std::optional<Programs> known = givenPrograms(options.source, status);
  if (!known) return std::nullopt;
  Result<replay::Recording> recording = replay::readRecording(options.file, std::move(*known));
  if (!recording.ok()) {
    status = environmentError(recording.error());
    return std::nullopt;
  }
  printProblems(recording.value());
  return std::move(recording).value();
}

int runAsked(const ReplayOptions& options, replay::Past& past, replay::Console& console) {
  int status = kOk;
  const uint64_t here = past.part();
  for (const std::string& name : options.show) {
    const Result<std::string> line = console.shown(name);
    if (!line.ok()) return usageError(line.error());
    fmt::print("{}\n", line.value());
  }
  if (!options.find.empty()) {
    const Result<std::vector<uint64_t>> found = console.findAll(options.find, options.most);
    if (!found.ok()) return usageError(found.error());
    if (options.json) fmt::print("{}\n", nlohmann::json{{"condition", options.find}, {"scans", found.value()}}.dump(2));
    for (const uint64_t part : found.value()) {
      if (options.json) break;
      if (const std::string problem = past.goTo(part); !problem.empty()) return environmentError(problem);
      fmt::print("{}\n", replay::positionText(past));
    }
    if (const std::string problem = past.goTo(here); !problem.empty()) return environmentError(problem);
    if (found.value().empty()) status = kWrong;
  }
  if (!options.why.empty()) {
    const std::string words[] = {options.why};
    const Result<std::string> text = console.why(words, options.json);
    if (!text.ok()) return usageError(text.error());
    fmt::print("{}\n", text.value());
  }
  if (!options.exported.empty()) {
    const Result<std::vector<std::string>> lacks =
        console.exportTo(options.exported, options.from.value_or(past.firstPart()),
                         options.to.value_or(past.contents().parts), options.watch);
    if (!lacks.ok()) return usageError(lacks.error());
    fmt::print("wrote {}\n", options.exported);
    for (const std::string& lack : lacks.value()) fmt::print(stderr, "rungc: {}: {}\n", options.exported, lack);
    if (!lacks.value().empty()) status = kWrong;
  }
  return status;
}

// Machine code is there at once where it pays: in a search of many scans.
replay::PastOptions pastOptions(const ReplayOptions& options, const replay::Recording& recording) {
  constexpr uint64_t kMany = 20'000;
  replay::PastOptions past;
  if (!options.find.empty() && replay::Contents(recording).parts > kMany) past.engine = compiler::EngineKind::Jit;
  return past;
}

// `refresh` is called before each line of the prompt.
int runPast(const ReplayOptions& options, replay::Past& past, const std::function<void()>& refresh) {
  const uint64_t first = options.at.value_or(past.contents().parts);
  if (const std::string problem = past.goTo(first); !problem.empty()) return usageError("--at: " + problem);
  replay::Console console(past, [](const std::string& line) { fmt::print("{}\n", line); });
  const bool asked =
      !options.show.empty() || !options.find.empty() || !options.why.empty() || !options.exported.empty();
  if (asked) return runAsked(options, past, console);
  scenario::Signal& stop = catchStop();
  if (options.web) return servePast(options.listen, past, options.source.files, [&stop] { return stop != 0; });
  return scenario::runPrompt(console, stop, refresh) ? int{kOk} : int{kWrong};
}

int runFollowed(const ReplayOptions& options) {
  int status = kOk;
  std::optional<Programs> known = givenPrograms(options.source, status);
  if (!known) return status;
  Result<FollowedHost> host = followHost(options.host, std::move(*known));
  if (!host.ok()) return environmentError(host.error());
  printProblems(host.value().followed.files->recording());
  return runPast(options, *host.value().followed.past, [&host] { host.value().refresh(); });
}

int runReplay(const ReplayOptions& options) {
  if (const std::string wrong = listenProblem(options.listen); !wrong.empty()) return usageError(wrong);
  if (options.file.empty() == options.host.empty())
    return usageError("replay needs either a RECORDING or --host NAME, the host that records");
  if (!options.host.empty()) return runFollowed(options);
  int status = kOk;
  const std::optional<replay::Recording> recording = openRecording(options, status);
  if (!recording) return status;
  Result<std::unique_ptr<replay::Past>> past = replay::Past::open(*recording, pastOptions(options, *recording));
  if (!past.ok()) return environmentError(fmt::format("{}: {}", options.file, past.error()));
  status = runPast(options, *past.value(), [] {});
  return status == kOk && !recording->problems.empty() ? int{kWrong} : status; // not all was there to be seen
}

} // namespace

void addReplay(CommandLine& app, int& status) {
  Command command = app.add("replay", "Go through the past of a program, forwards and backwards");
  auto options = std::make_shared<ReplayOptions>();
  command.option("RECORDING", options->file,
                 "The folder of a recording, one of its segments, or a scenario, which is run and recorded");
  Option host = command.option("--host", options->host,
                               "Instead: the last ten minutes of this host, which runs; names are as for rungctl");
  command.option("--source", options->source.files,
                 "Sources of the program, if the recording does not have it; their hash must be that of the recording");
  command.option("--at", options->at, "Begin at the end of this scan; default: the last one, or where it failed");
  command.option("--show", options->show, "Print the values of these names there").oneValue();
  command.option("--find", options->find, "Print the scans after which this condition begins to hold");
  command.option("--most", options->most, "At most so many scans are found").showDefault();
  command.option("--why", options->why,
                 "NAME, NAME@SCAN or NAME@TIME (LAMP@12.5s): print the chain from the value back to what it came from");
  command.option("--export", options->exported,
                 "Write values of each scan to FILE.vcd or FILE.csv, or a scenario that does the same to FILE.scn");
  command.option("--from", options->from, "First scan of --export");
  command.option("--to", options->to, "Last scan of --export");
  command.option("--watch", options->watch, "Names for --export; default: all that the rungs use").oneValue();
  command.flag("--json", options->json, "JSON from --find and --why");
  Option web = command.flag("--web", options->web, "Show it in a browser: prints a link").excludes(host);
  command.option("--listen", options->listen, "Address for --web, such as 8080 or 192.168.0.5:8080")
      .needs(web)
      .showDefault();
  command.onRun([options, &status] { status = runReplay(*options); });
}

} // namespace rung::rungc
