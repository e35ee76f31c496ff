// rungc wcet: the longest time that a run of each task can take.
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <optional>

#include "compiler/engines.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/scenarios.h"
#include "tools/scenario/prompt.h"
#include "tools/scenario/wcet_measure.h"

namespace rung::rungc {
namespace {

struct WcetOptions {
  SourceOptions source;
  std::string scenarioFile;
  RunScenario scenario;
};

// Returns the exit status; problems are printed.
int findBounds(const WcetOptions& options, const ConfigPairs& config, const compiler::Compiled& compiled,
               codegen::JitEngine& engine, report::Bounds& bounds) {
  const scenario::Working working("measuring");
  bounds = report::boundsOf(compiled, engine);
  if (options.scenarioFile.empty()) return kOk;
  const scenario::TaskDrive drive{.name = options.scenarioFile,
                                  .config = config,
                                  .connects = options.scenario.connects,
                                  .statements = options.scenario.statements};
  const Result<void> done = scenario::measureTasks(compiled, engine, drive, bounds);
  if (done.ok()) return kOk;
  fmt::print(stderr, "rungc: {}\n", done.error());
  return kWrong;
}

int runWcet(const WcetOptions& options) {
  for (const std::string& file : options.source.files)
    if (file.ends_with(".so"))
      return usageError(fmt::format("wcet needs the sources: '{}' is a compiled program", file));
  int status = kOk;
  const std::optional<ConfigPairs> config = configPairs(options.source.config, status);
  if (!config) return status;
  SourceManager sources;
  compiler::CompileRequest request;
  if (options.scenario.periodUs > 0) request.options.config["period_us"] = std::to_string(options.scenario.periodUs);
  SourceOptions diagnostics = options.source;
  diagnostics.json = false; // standard output is reserved for the bounds
  const std::optional<compiler::Compiled> compiled = compileSources(sources, diagnostics, request, status);
  if (!compiled) return status;
  const Result<std::unique_ptr<codegen::JitEngine>> engine = report::compileWithLengths(*compiled);
  if (!engine.ok()) return environmentError(engine.error());
  report::Bounds bounds;
  status = findBounds(options, *config, *compiled, *engine.value(), bounds);
  if (status != kOk) return status;
  const rung_program& program = engine.value()->program();
  std::cout << (options.source.json ? report::jsonOf(bounds, program) : report::textOf(bounds, program));
  return kOk;
}

} // namespace

void addWcet(CommandLine& app, int& status) {
  Command command = app.add("wcet", "Report the worst-case execution time of each task, and the path that causes it");
  auto options = std::make_shared<WcetOptions>();
  addSourceOptions(command, options->source, "Print everything as JSON (docs/wcet-format.md)");
  command.option("--scenario", options->scenarioFile,
                 "Also measure the runs of this scenario; without FILE, of the scenario's own program");
  command.onParsed([options] {
    int wrong = kOk;
    if (!options->scenarioFile.empty())
      wrong = readRunScenario(options->scenarioFile, options->source, options->scenario);
    return wrong == kOk ? takeProject(options->source) : wrong;
  });
  command.onRun([options, &status] { status = runWcet(*options); });
}

} // namespace rung::rungc
