// The project of a scenario (see in_project.h).
#include "tools/scenario/in_project.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

#include "compiler/project.h"
#include "ir/support/diag_render.h"

namespace rung::scenario {
namespace {

namespace fs = std::filesystem;

bool hasProgram(const Scenario& scenario) {
  return std::any_of(scenario.statements.begin(), scenario.statements.end(),
                     [](const Statement& s) { return s.kind == Kind::Program; });
}

bool configures(const Scenario& scenario, const std::string& key) {
  return std::any_of(scenario.statements.begin(), scenario.statements.end(),
                     [&](const Statement& s) { return s.kind == Kind::Config && s.name == key; });
}

Statement statementOf(Kind kind, std::string name) {
  Statement statement;
  statement.kind = kind;
  statement.name = std::move(name);
  return statement;
}

// With paths as a scenario writes them: relative to its folder.
Statement programOf(const compiler::Project& project, const fs::path& folder) {
  Statement statement = statementOf(Kind::Program, "");
  for (const std::string& file : project.files) {
    const fs::path relative = fs::path(file).lexically_relative(folder.empty() ? "." : folder);
    statement.words.push_back(relative.empty() ? file : relative.string());
  }
  return statement;
}

} // namespace

bool takeProject(Scenario& scenario) {
  if (hasProgram(scenario)) return false;
  const fs::path folder = fs::path(scenario.path).parent_path().lexically_normal();
  const auto file = compiler::findUpwards(folder.string());
  if (!file) return false;
  SourceManager sources;
  Diagnostics diagnostics;
  const auto project = compiler::load(sources, *file, diagnostics);
  if (!project) {
    scenario.problems.push_back(
        {scenario.path, 1, "the project file has mistakes:\n" + renderText(diagnostics, sources)});
    scenario.startUnknown = true;
    return true;
  }
  std::vector<Statement> first = {programOf(*project, folder), statementOf(Kind::Dialect, project->dialect)};
  for (const compiler::Setting& setting : project->config) {
    if (configures(scenario, setting.key)) continue;
    first.push_back(statementOf(Kind::Config, setting.key));
    first.back().value.kind = ValueKind::Text;
    first.back().value.text = setting.value;
  }
  scenario.project = project->name;
  scenario.includePaths = project->includePaths;
  for (Statement& statement : first) {
    statement.file = scenario.path;
    statement.line = 1;
  }
  scenario.files.push_back(*file);
  scenario.statements.insert(scenario.statements.begin(), first.begin(), first.end());
  return true;
}

} // namespace rung::scenario
