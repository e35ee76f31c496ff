// Compiles the program of a scenario.
#include "tools/scenario/compile_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "compiler/configuration.h"
#include "ir/support/diag_render.h"
#include "rtlib/text/similar.h"
#include "tools/report/odd_names.h"

namespace rung::scenario {

namespace {

struct Reported {
  const Diagnostic* diagnostic;
  uint32_t line; // 0: no position
  bool expected = false;
};

std::vector<Reported> reportedOf(const Diagnostics& diagnostics, const SourceManager& sources) {
  std::vector<Reported> out;
  for (const Diagnostic* d : diagnostics.sorted())
    out.push_back({d, d->range.valid() ? sources.lineCol(d->range.begin).line : 0});
  return out;
}

std::string listOf(const std::vector<Reported>& reported, Severity severity) {
  std::string text;
  for (const Reported& r : reported)
    if (r.diagnostic->severity == severity)
      text += fmt::format("{}{} (line {})", text.empty() ? "" : ", ", diagInfo(r.diagnostic->id).code, r.line);
  return text.empty() ? "none" : text;
}

std::string similarCode(std::string_view code) {
  return text::didYouMean(text::mostSimilar(code, allDiags(), &DiagInfo::code));
}

const Statement* firstOf(const Scenario& scenario, Kind kind) {
  const auto found = std::ranges::find(scenario.statements, kind, &Statement::kind);
  return found == scenario.statements.end() ? nullptr : &*found;
}

// Every expected diagnostic must have been reported.
void checkExpected(const Scenario& scenario, std::vector<Reported>& reported, std::vector<Problem>& problems) {
  for (const Statement& s : scenario.statements) {
    if (s.kind != Kind::ExpectError && s.kind != Kind::ExpectWarning) continue;
    const Severity severity = s.kind == Kind::ExpectError ? Severity::Error : Severity::Warning;
    if (findDiag(s.name) == nullptr) {
      problems.push_back(problemAt(s, fmt::format("there is no diagnostic '{}'{}", s.name, similarCode(s.name))));
      continue;
    }
    bool found = false;
    for (Reported& r : reported) {
      if (r.diagnostic->severity != severity || diagInfo(r.diagnostic->id).code != s.name) continue;
      if (s.number != 0 && s.number != r.line) continue;
      found = r.expected = true;
    }
    if (!found)
      problems.push_back(problemAt(
          s, fmt::format("expected {} {}{}; reported: {}", severity == Severity::Error ? "error" : "warning", s.name,
                         s.number == 0 ? "" : fmt::format(" at line {}", s.number), listOf(reported, severity))));
  }
}

// Any other error is a problem, unless the scenario allows errors.
void checkOthers(const Scenario& scenario, const std::vector<Reported>& reported, const SourceManager& sources,
                 std::vector<Problem>& problems) {
  const Statement* first = firstOf(scenario, Kind::ExpectError);
  const Statement* allow = firstOf(scenario, Kind::AllowErrors);
  if (allow != nullptr && first == nullptr)
    problems.push_back(problemAt(*allow, "allow_errors needs an expect_error, besides which it allows other errors"));
  if (allow != nullptr || first == nullptr) return;
  Diagnostics others;
  for (const Reported& r : reported)
    if (r.diagnostic->severity == Severity::Error && !r.expected) others.add(*r.diagnostic);
  if (others.hasErrors())
    problems.push_back(
        problemAt(*first, "there are errors that no expect_error names; name them, or write allow_errors:\n" +
                              renderText(others, sources)));
}

void checkNames(const Scenario& scenario, const compiler::Compiled& compiled, const SourceManager& sources,
                std::vector<Problem>& problems) {
  for (const Statement& s : scenario.statements) {
    if (s.kind != Kind::Config) continue;
    const std::pair<std::string, std::string> config[] = {{s.name, s.value.text}};
    for (const compiler::ConfigProblem& problem : compiler::checkNamesOfProgram(*compiled.dialect, sources, config))
      problems.push_back(problemAt(s, problem.text));
  }
}

} // namespace

bool readsKey(const frontend::Dialect& dialect, std::string_view key) {
  const nc::ConfigKey* row = nc::findConfigKey(dialect.configKeys, key);
  return row != nullptr && row->reader == nc::ConfigReader::Compiler;
}

std::vector<std::string> programPaths(const Statement& s) {
  std::vector<std::string> paths;
  for (const std::string& file : s.words)
    paths.push_back((std::filesystem::path(s.file).parent_path() / file).lexically_normal().string());
  return paths;
}

namespace {

compiler::CompileRequest requestOf(const Scenario& scenario, const CompileSettings& settings) {
  compiler::CompileRequest request;
  request.options.strict = settings.strict;
  request.instrument = settings.instrument;
  request.marks = settings.marks;
  request.optimise = settings.optimise;
  request.keepBuilt = true;
  for (const Statement& s : scenario.statements) {
    if (s.kind == Kind::Dialect) request.dialect = s.name;
    if (s.kind == Kind::Period) request.options.config["period_us"] = std::to_string(s.microseconds);
    if (s.kind == Kind::Config) request.options.config[s.name] = s.value.text;
  }
  request.name = scenario.project;
  request.options.includePaths = scenario.includePaths;
  return request;
}

// Nothing if a file cannot be read.
std::optional<std::vector<FileId>> addFiles(SourceManager& sources, const std::vector<std::string>& names,
                                            const compiler::CompileRequest& request, CompileStep& step) {
  Result<std::vector<FileId>> files = compiler::addFiles(sources, names, request.options.config);
  if (files.ok()) return std::move(files).value();
  step.files = names; // a missing file may be created later
  step.environment = files.error();
  return std::nullopt;
}

// Where warnings are expected, it warns like `rungc check`.
void compileFiles(SourceManager& sources, const std::vector<FileId>& files, compiler::CompileRequest request,
                  bool warnsOfNames, Diagnostics& diagnostics, CompileStep& step) {
  std::unique_ptr<const frontend::CheckedProgram> text;
  if (warnsOfNames) request.source = &text;
  step.program = compiler::compile(sources, files, request, diagnostics);
  if (step.program && warnsOfNames)
    report::reportOddNames(sources, text->analysis(), *step.program->layout, *step.program->uses,
                           step.program->dialect->shownSpaces, diagnostics);
  for (uint32_t i = 0; i < sources.fileCount(); ++i) step.files.emplace_back(sources.name(FileId{i}));
}

} // namespace

CompileStep compileProgram(const Scenario& scenario, const std::vector<std::string>& programs,
                           const CompileSettings& settings) {
  CompileStep step;
  std::vector<std::string> names = programs;
  const Statement* named = firstOf(scenario, Kind::Program);
  if (programs.empty() && named != nullptr) names = programPaths(*named);
  SourceManager sources;
  const compiler::CompileRequest request = requestOf(scenario, settings);
  const auto files = addFiles(sources, names, request, step);
  if (!files) return step;
  Diagnostics diagnostics;
  const bool warnsOfNames = firstOf(scenario, Kind::ExpectWarning) != nullptr;
  compileFiles(sources, *files, request, warnsOfNames, diagnostics, step);
  std::vector<Reported> reported = reportedOf(diagnostics, sources);
  checkExpected(scenario, reported, step.problems);
  checkOthers(scenario, reported, sources, step.problems);
  const bool errorExpected = firstOf(scenario, Kind::ExpectError) != nullptr;
  if (!errorExpected && !step.program)
    step.problems.push_back(
        problemAt(scenario.statements[0], "the program has errors:\n" + renderText(diagnostics, sources)));
  if (step.program) checkNames(scenario, *step.program, sources, step.problems);
  if (errorExpected) step.program.reset();
  return step;
}

std::string dialectProblem(const SourceManager& sources, FileId file, std::string_view running) {
  const frontend::Dialect* own = frontend::dialectOf(sources, file);
  if (own == nullptr || own->name == running) return {};
  return fmt::format("{} has the dialect {}, but the running program has {}", sources.name(file), own->name, running);
}

CompileStep compileNext(const Scenario& scenario, const Statement& s, const frontend::Dialect& dialect,
                        const CompileSettings& settings) {
  CompileStep step;
  SourceManager sources;
  compiler::CompileRequest request = requestOf(scenario, settings);
  const auto files = addFiles(sources, programPaths(s), request, step);
  if (!files) return step;
  if (std::string problem = dialectProblem(sources, files->front(), dialect.name); !problem.empty()) {
    step.problems.push_back(problemAt(s, std::move(problem)));
    return step;
  }
  request.dialect = dialect.name;
  request.name.clear(); // another program than the project's
  Diagnostics diagnostics;
  compileFiles(sources, *files, request, false, diagnostics, step);
  if (!step.program)
    step.problems.push_back(problemAt(s, "the program has errors:\n" + renderText(diagnostics, sources)));
  return step;
}

// Engines of programs that several scenarios run.

Result<runtime::Engine*> StoredProgram::engine(compiler::EngineKind kind, const compiler::EngineOptions& options) {
  const std::lock_guard lock(mutex_);
  auto found = engines_.find(kind);
  if (found == engines_.end()) {
    Result<std::unique_ptr<runtime::Engine>> made = compiler::makeEngine(kind, compiled_, options);
    if (!made.ok()) return made.failure();
    found = engines_.emplace(kind, std::move(made).value()).first;
  }
  return found->second.get();
}

std::shared_ptr<StoredProgram> EngineStore::enter(compiler::Compiled compiled) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(programs_.begin(), programs_.end(), [&](const std::shared_ptr<StoredProgram>& stored) {
        return stored->compiled().codeHash == compiled.codeHash;
      });
  if (found != programs_.end()) {
    programs_.splice(programs_.begin(), programs_, found);
  } else {
    programs_.push_front(std::make_shared<StoredProgram>(std::move(compiled)));
    if (programs_.size() > kPrograms) programs_.pop_back();
  }
  return programs_.front();
}

} // namespace rung::scenario
