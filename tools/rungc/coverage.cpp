// Coverage of programs by scenarios (see coverage.h).
#include "tools/rungc/coverage.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <string_view>

#include "rtlib/text/regular_file.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/pages.h"

namespace rung::rungc {
namespace {

Result<report::CoverageReport> readReport(const std::string& path) {
  std::string contents;
  const std::string problem = text::readRegular(path, text::kMostSource, contents);
  if (!problem.empty()) return failure(fmt::format("cannot read '{}': {}", path, problem));
  Result<report::CoverageReport> report = report::fromJson(contents);
  if (!report.ok()) return failure(fmt::format("'{}' is not a report of --coverage-json: {}", path, report.error()));
  return report;
}

// Every share must reach the requested minimum.
int checkLeast(const report::Totals& totals, double least) {
  int status = kOk;
  const auto check = [&](std::string_view what, const report::Share& share) {
    if (share.percent() >= least) return;
    fmt::print(stderr, "rungc: coverage: {} {}, less than the {:g} % of --coverage-min\n", what,
               report::percentText(share), least);
    status = kWrong;
  };
  check("rungs run", totals.rungs);
  check("contacts open and closed", totals.contacts);
  check("coils on and off", totals.coils);
  check("conditions shown to decide", totals.decided);
  return status;
}

// "lathe.html", "lathe-2.html"
std::string numbered(const std::string& path, size_t number) {
  if (number == 1) return path;
  const std::filesystem::path whole(path);
  return (whole.parent_path() / fmt::format("{}-{}{}", whole.stem().string(), number, whole.extension().string()))
      .string();
}

} // namespace

void addCoverageOptions(Command command, CoverageOptions& options) {
  command.flag(
      "--coverage", options.text,
      "Report which rungs ran, which contacts and coils were seen in both states, which conditions decided alone");
  command.flag("--coverage-all", options.all, "Like --coverage, but list everything that is not covered");
  command.option("--coverage-json", options.json, "Write the coverage to this file as JSON (docs/coverage-format.md)");
  command.option(
      "--coverage-html", options.html,
      "Write a page that shows the coverage on the drawing; a second program is written to FILE-2.html, and so on");
  command.option("--coverage-merge", options.former, "Add the coverage of an earlier run, written by --coverage-json")
      .oneValue();
  command.option("--coverage-min", options.least, "Fail if one of the four shares is less than this percentage")
      .between(0.0, 100.0);
}

void CoverageRun::observe(scenario::RunOptions& run) {
  run.engines = {compiler::EngineKind::Interp};
  run.store = nullptr; // a separate engine for each scenario: each thread counts on its own
  run.engine.observer = [this](const compiler::Compiled& compiled) {
    const std::lock_guard lock(mutex_);
    Origin origin{std::string(compiled.dialect->name), compiled.project, compiled.options};
    origin.options.configPlaces.clear(); // they are positions in the sources of this compilation
    origins_.try_emplace(compiled.module->files, std::move(origin));
    return collection_.observe(*compiled.module, compiled.marks);
  };
}

// Writes a page for each program that ran; programs known from former runs only are not drawn.
int CoverageRun::writePages(const report::CoverageReport& report, const std::string& path) const {
  size_t pages = 0;
  for (const report::Program& program : report.programs) {
    const auto origin = origins_.find(program.files);
    if (origin == origins_.end()) continue;
    const auto& [dialect, project, options] = origin->second;
    const Result<std::string> page = coveragePage(program, *frontend::findDialect(dialect), options, project);
    if (!page.ok()) return environmentError(page.error());
    const std::string out = numbered(path, ++pages);
    if (const int status = writeFile(page.value(), out); status != kOk) return status;
    fmt::print("coverage of {}: {}\n", program.files[0], out);
  }
  return kOk;
}

int CoverageRun::finish(const CoverageOptions& options) const {
  report::CoverageReport report = collection_.report();
  for (const std::string& path : options.former) {
    const Result<report::CoverageReport> former = readReport(path);
    if (!former.ok()) return environmentError(former.error());
    report::mergeFormer(report, former.value());
  }
  if (options.text || options.all)
    fmt::print("\n{}", report::toText(report, {.missing = options.all ? 0 : report::CoverageTextOptions{}.missing}));
  int status = kOk;
  if (!options.json.empty()) status = std::max(status, writeFile(report::toJson(report), options.json));
  if (!options.html.empty()) status = std::max(status, writePages(report, options.html));
  if (options.least > 0) status = std::max(status, checkLeast(report::totalsOf(report), options.least));
  return status;
}

} // namespace rung::rungc
