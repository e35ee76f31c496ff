// See check.h.
#include "tools/source/check.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "compiler/configuration.h"
#include "tools/report/odd_names.h"
#include "tools/scenario/configuration.h"

namespace rung::source {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

void checkSettings(const compiler::Project& project, const SourceManager& sources, Diagnostics& diagnostics) {
  Pairs pairs;
  for (const compiler::Setting& setting : project.config) pairs.emplace_back(setting.key, setting.value);
  const frontend::Dialect& dialect = *frontend::findDialect(project.dialect);
  for (const compiler::ConfigProblem& problem : scenario::checkConfiguration(dialect, pairs)) {
    const auto setting = std::ranges::find(project.config, problem.key, &compiler::Setting::key);
    compiler::report(problem, dialect, sources.range(FileId{0}, setting->begin, setting->end), diagnostics);
  }
}

void checkNames(const compiler::Compiled& compiled, const SourceManager& sources,
                const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  const Pairs pairs(options.config.begin(), options.config.end());
  for (const compiler::ConfigProblem& problem : compiler::checkNamesOfProgram(*compiled.dialect, sources, pairs))
    compiler::report(problem, *compiled.dialect, options.placeOf(problem.key), diagnostics);
}

} // namespace

std::optional<compiler::Compiled> compile(SourceManager& sources, std::span<const FileId> files,
                                          const compiler::CompileRequest& request, Diagnostics& diagnostics) {
  std::optional<compiler::Compiled> compiled = compiler::compile(sources, files, request, diagnostics);
  if (compiled) checkNames(*compiled, sources, request.options, diagnostics);
  if (diagnostics.hasErrors()) compiled.reset();
  return compiled;
}

std::optional<compiler::Compiled> check(SourceManager& sources, std::span<const FileId> files,
                                        compiler::CompileRequest request, Diagnostics& diagnostics) {
  std::unique_ptr<const frontend::CheckedProgram> own;
  if (request.source == nullptr) request.source = &own;
  std::optional<compiler::Compiled> compiled = source::compile(sources, files, request, diagnostics);
  if (compiled)
    report::reportOddNames(sources, (*request.source)->analysis(), *compiled->layout, *compiled->uses,
                           compiled->dialect->shownSpaces, diagnostics);
  return compiled;
}

std::optional<compiler::Project> loadProject(SourceManager& sources, const std::string& file,
                                             Diagnostics& diagnostics) {
  std::optional<compiler::Project> project = compiler::load(sources, file, diagnostics);
  if (project) checkSettings(*project, sources, diagnostics);
  if (diagnostics.hasErrors()) project.reset();
  return project;
}

} // namespace rung::source
