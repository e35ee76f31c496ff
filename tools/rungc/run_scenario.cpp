// The scenario of a run (see run_scenario.h).
#include "tools/rungc/run_scenario.h"

#include <filesystem>
#include <fmt/format.h>

#include "frontend/dialects/dialect.h"
#include "rtlib/nc/config_key.h"
#include "tools/scenario/session.h"

namespace rung::rungc {
namespace {

namespace fs = std::filesystem;
using scenario::Kind;
using scenario::Statement;

std::string inFolderOf(const std::string& file, const std::string& name) {
  return (fs::path(file).parent_path() / name).lexically_normal().string();
}

// Files that the control reads lie relative to the scenario.
std::string configOf(const Statement& s) {
  for (const frontend::Dialect* dialect : frontend::allDialects()) {
    const nc::ConfigKey* row = nc::findConfigKey(dialect->configKeys, s.name);
    if (row != nullptr && row->form == nc::ConfigForm::File && row->reader == nc::ConfigReader::Control)
      return s.name + "=" + inFolderOf(s.file, s.value.text);
  }
  return s.name + "=" + s.value.text;
}

// A scenario without a program runs that of the project that it lies in.
int findProgram(const std::string& path, const std::vector<std::string>& programs, SourceOptions& options) {
  if (!options.files.empty() || !options.projectFile.empty()) return kOk;
  if (!programs.empty()) {
    options.files = programs;
    options.noProject = true;
    return kOk;
  }
  const auto project = compiler::findUpwards(fs::path(path).parent_path().lexically_normal().string());
  if (!project) return usageError(fmt::format("{} names no program and is not in a project: name the program", path));
  options.projectFile = *project;
  return kOk;
}

} // namespace

int readRunScenario(const std::string& path, SourceOptions& options, RunScenario& scenario) {
  Result<scenario::Scenario> read = scenario::readStatements(path);
  if (!read.ok()) return environmentError(read.error());
  for (const scenario::Problem& problem : read.value().problems) fmt::print(stderr, "{}\n", textOf(problem));
  if (!read.value().problems.empty()) return kWrong;
  std::vector<std::string> programs;
  std::vector<std::string> config;
  std::string dialect;
  for (Statement& s : read.value().statements) {
    switch (s.kind) {
    case Kind::Program:
      for (const std::string& file : s.words) programs.push_back(inFolderOf(s.file, file));
      break;
    case Kind::Dialect: dialect = s.name; break;
    case Kind::Config: config.push_back(configOf(s)); break;
    case Kind::Connect: scenario.connects.push_back(std::move(s)); break;
    case Kind::Period: scenario.periodUs = s.microseconds; break;
    case Kind::ExpectError:
      return usageError(
          fmt::format("{}:{}: the program of this scenario does not compile, so it cannot be run", s.file, s.line));
    case Kind::ExpectWarning:
    case Kind::AllowErrors: break; // the diagnostics are shown
    default: scenario.statements.push_back(std::move(s));
    }
  }
  options.config.insert(options.config.begin(), config.begin(), config.end());
  const bool ownProgram = options.files.empty() && options.projectFile.empty();
  if (ownProgram && options.dialect.empty()) options.dialect = dialect;
  return findProgram(path, programs, options);
}

} // namespace rung::rungc
