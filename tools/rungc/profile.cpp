// rungc profile: measures the cost of every rung and every scan while scenarios drive the program.
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>

#include "rtlib/text/regular_file.h"
#include "tools/report/profile_branches.h"
#include "tools/report/profile_text.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/pages.h"
#include "tools/rungc/scenarios.h"
#include "tools/scenario/prompt.h"

namespace rung::rungc {
namespace {

struct ProfileOptions {
  std::vector<std::string> files;
  std::vector<std::string> scenarios;
  std::string engine = "jit";
  std::string by = "operations";
  std::string baseline;
  std::string html;
  std::string out;
  report::ProfileTextOptions text;
  uint32_t repeat = 5;
  bool json = false;
};

// Scenarios and program files may be given in any order: scenarios are folders and names that end in .scn.
bool isScenario(const std::string& name) {
  std::error_code none;
  return name.ends_with(".scn") || std::filesystem::is_directory(name, none);
}

// Returns the exit status.
int sortNames(const ProfileOptions& options, scenario::ProfileRequest& request) {
  std::vector<std::string> scenarios;
  for (const std::vector<std::string>* names : {&options.scenarios, &options.files})
    for (const std::string& name : *names) (isScenario(name) ? scenarios : request.programs).push_back(name);
  if (scenarios.empty() && !request.programs.empty())
    return usageError("profile needs a scenario (.scn) that drives the program");
  int status = kOk;
  const std::optional<std::vector<std::string>> files = scenarioFiles(scenarios, status);
  if (!files) return status;
  for (const std::string& file : *files) {
    Result<scenario::Scenario> read = scenario::readScenario(file);
    if (!read.ok()) return environmentError(read.error());
    request.scenarios.push_back(std::move(read).value());
  }
  return kOk;
}

Result<report::Baseline> openBaseline(const std::string& path) {
  std::string contents;
  const std::string problem = text::readRegular(path, text::kMostSource, contents);
  if (!problem.empty()) return failure(fmt::format("cannot read '{}': {}", path, problem));
  Result<report::Baseline> baseline = report::readBaseline(contents);
  return baseline.ok() ? std::move(baseline) : failure(fmt::format("{}: {}", path, baseline.error()));
}

int runProfile(const ProfileOptions& options) {
  scenario::ProfileRequest request;
  const auto engine = compiler::engineFromName(options.engine);
  if (!engine || *engine == compiler::EngineKind::Tiered) // its times would be those of two engines
    return usageError("--engine takes one of interp, cpp, llvm and jit");
  request.engine = *engine;
  request.order = options.by == "time" ? report::Order::Time : report::Order::Operations;
  request.repeat = options.repeat;
  if (const int status = sortNames(options, request); status != kOk) return status;
  std::optional<report::Comparison> comparison;
  std::optional<report::Baseline> baseline;
  if (!options.baseline.empty()) { // read first: a wrong file must not waste the measurements
    Result<report::Baseline> read = openBaseline(options.baseline);
    if (!read.ok()) return environmentError(read.error());
    baseline = std::move(read).value();
  }
  ir::BranchCounts branches;
  if (!options.out.empty()) request.branches = &branches;
  const scenario::ProfileOutcome outcome = [&] {
    scenario::Working working("compiling");
    request.progress = [&](const std::string& text) { working.say(text); };
    return scenario::profileScenarios(request);
  }();
  if (!outcome.done) {
    printResult({outcome.scenario, 0, outcome.result});
    return outcome.result.environment.empty() ? kWrong : kEnvironment;
  }
  if (baseline) comparison = report::compare(outcome.profile.report, std::move(*baseline));
  if (!options.html.empty()) {
    const Result<std::string> page = profilePage(outcome.profile, request);
    if (!page.ok()) return environmentError(page.error());
    if (const int status = writeFile(page.value(), options.html); status != kOk) return status;
  }
  if (!options.out.empty())
    if (const int status = writeFile(report::branchesJson(branches), options.out); status != kOk) return status;
  if (options.json) {
    std::cout << report::profileJson(outcome.profile, comparison ? &*comparison : nullptr);
    return kOk;
  }
  std::cout << report::profileText(outcome.profile, options.text);
  if (comparison) std::cout << '\n' << report::comparisonText(outcome.profile, *comparison, options.text.top);
  return kOk;
}

} // namespace

void addProfile(CommandLine& app, int& status) {
  Command command = app.add("profile", "Measure the cost of every rung and scan while scenarios run");
  auto options = std::make_shared<ProfileOptions>();
  command.option("FILE", options->files,
                 "Scenarios (.scn, folders) of one program, optionally its files instead of those named in the "
                 "scenarios; default: those of the project");
  command.option("--scenario", options->scenarios, "Another way to name a scenario");
  command.option("--engine", options->engine, "Engine to measure: interp, cpp, llvm or jit").showDefault();
  command
      .option("--by", options->by,
              "Sort by operations (exact, the same in every run) or by time (of all scans, without interruptions)")
      .oneOf({"operations", "time"})
      .showDefault();
  command.option("--repeat", options->repeat, "Number of timed runs").between(1, 1000).showDefault();
  command.option("--top", options->text.top, "Lines per table; 0: all").showDefault();
  command.flag("--never", options->text.never, "List the rungs that never ran");
  command.option("--baseline", options->baseline, "Compare with a profile that --json wrote");
  command.option("--html", options->html, "Write a page with the drawing, its rungs coloured by their share");
  command.option("-o,--output", options->out, "Write how often each branch was taken, for rungc build --profile-use");
  command.flag("--json", options->json, "Print everything as JSON (docs/profile-format.md)");
  command.onRun([options, &status] { status = runProfile(*options); });
}

} // namespace rung::rungc
