// Options and steps that all compiling commands share.
#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <iostream>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <unistd.h>

#include "compiler/configuration.h"
#include "ir/support/diag_render.h"
#include "rtlib/load/file.h"
#include "rtlib/text/controls.h"
#include "tools/report/odd_names.h"
#include "tools/rungc/commands.h"
#include "tools/scenario/configuration.h"
#include "tools/scenario/prompt.h"

namespace rung::rungc {

void addSourceOptions(Command command, SourceOptions& options, const std::string& json) {
  command.option("FILE", options.files,
                 "Source files in order (.lad, .pmc, .plc), or the folder of a project; - reads standard input; "
                 "default: the project (rung.toml) of the working directory or of a folder above it");
  Option project = command.option("--project", options.projectFile, "Use this project file, or the one in this folder");
  command.flag("--no-project", options.noProject, "Use only the named files, not the project that they belong to")
      .excludes(project);
  command.option("--dialect", options.dialect, "nct, gsk or technol; needed if the file does not name it");
  command.option("--config", options.config, "KEY=VALUE of the dialect's configuration; may be repeated").oneValue();
  command.flag("--strict", options.strict, "Treat warnings that the real control would reject as errors");
  command.flag("--json", options.json, json);
  command.flag("-q,--quiet", options.quiet, "Print only errors and warnings");
  addColorOption(command, options.color, "Colours in diagnostics");
  command.onParsed([&options] { return takeProject(options); });
}

void addColorOption(Command command, std::string& color, const std::string& what) {
  command.option("--color", color, what).oneOf({"auto", "always", "never"});
}

bool wantsColor(const std::string& color, int file) {
  return color == "always" || (color == "auto" && isatty(file) != 0);
}

void addLevelOption(Command command, std::string& level) {
  command.option("-O", level, "0: compile fast, 2: run fast").oneOf({"0", "2"}).showDefault();
}

namespace {

void complain(const std::string& message) { fmt::print(stderr, "rungc: {}\n", text::withoutControls(message, "\n\t")); }

} // namespace

int usageError(const std::string& message) {
  complain(message);
  return kUsage;
}

int environmentError(const std::string& message) {
  complain(message);
  return kEnvironment;
}

int sayWrote(int status, const std::string& out, const SourceOptions& options) {
  if (status == kOk && !options.quiet && !options.json) fmt::print("wrote {}\n", out);
  return status;
}

int writeFile(const std::string& text, const std::string& out) {
  const std::string wrong = runtime::replaceFile(out, text);
  return wrong.empty() ? kOk : environmentError(wrong);
}

int writeOutput(const std::string& text, const std::string& out) {
  if (!out.empty() && out != "-") return writeFile(text, out);
  std::cout << text; // where that fails, CommandLine::run says so
  return kOk;
}

namespace {

std::string counted(size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

size_t rungsOf(const ir::Module& module) {
  std::set<uint32_t> numbers; // a drawn rung that calls is several in the module
  for (const ir::Routine& routine : module.routines)
    for (const ir::Rung& rung : routine.rungs) numbers.insert(rung.number);
  numbers.erase(0); // the compiler's
  return numbers.size();
}

} // namespace

void printDiagnostics(const Diagnostics& diagnostics, const SourceManager& sources, const SourceOptions& options) {
  if (options.json) {
    std::cout << renderJson(diagnostics, sources) << '\n';
    return;
  }
  RenderOptions render;
  render.color = wantsColor(options.color, STDERR_FILENO);
  std::cerr << renderText(diagnostics, sources, render);
  std::cerr << closingLine(diagnostics);
}

void printSummary(const compiler::Compiled& compiled, const SourceOptions& options, const std::string& written) {
  if (options.quiet || options.json) return;
  const std::string what = options.project             ? options.project->file
                           : options.files.size() == 1 ? options.files[0]
                                                       : fmt::format("{} files", options.files.size());
  const std::string of = options.project ? fmt::format(" ({})", counted(options.files.size(), "file")) : "";
  fmt::print("{}{}: {}, {}{}\n", what, of, counted(rungsOf(*compiled.module), "rung"),
             compiled.warnings == 0 ? "no warnings" : counted(compiled.warnings, "warning"),
             written.empty() ? "" : "; wrote " + written);
}

std::optional<ConfigPairs> configPairs(const std::vector<std::string>& config, int& status) {
  ConfigPairs pairs;
  for (const std::string& pair : config) {
    const size_t equals = pair.find('=');
    if (equals == std::string::npos || equals == 0) {
      status = usageError(fmt::format("--config takes KEY=VALUE, found '{}'", pair));
      return std::nullopt;
    }
    pairs.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
  }
  return pairs;
}

namespace {

const frontend::Dialect* dialectOf(const SourceManager& sources, std::span<const FileId> files,
                                   const SourceOptions& options) {
  Diagnostics discarded; // who compiles reports it
  return files.empty() ? nullptr : compiler::chooseDialect(sources, files, options.dialect, discarded);
}

// Those of --config; the project's have been checked with their places.
int checkNamedConfig(const frontend::Dialect& dialect, const ConfigPairs& config) {
  int status = kOk;
  for (const compiler::ConfigProblem& problem : scenario::checkConfiguration(dialect, config))
    status = usageError("--config " + problem.text);
  return status;
}

void checkNames(const compiler::Compiled& compiled, const SourceManager& sources,
                const frontend::CompileOptions& compile, Diagnostics& diagnostics) {
  const ConfigPairs pairs(compile.config.begin(), compile.config.end());
  for (const compiler::ConfigProblem& problem : compiler::checkNamesOfProgram(*compiled.dialect, sources, pairs))
    compiler::report(problem, *compiled.dialect, compile.placeOf(problem.key), diagnostics);
}

} // namespace

std::optional<std::vector<FileId>> addSources(SourceManager& sources, const SourceOptions& options,
                                              frontend::CompileOptions& compile, int& status) {
  compile.strict = options.strict;
  const auto pairs = configPairs(options.config, status);
  if (!pairs) return std::nullopt;
  for (const auto& [key, value] : *pairs) compile.config[key] = value;
  const Result<std::vector<FileId>> files = compiler::addFiles(sources, options.files, compile.config);
  if (!files.ok()) {
    status = environmentError(files.error());
    return std::nullopt;
  }
  if (options.project) {
    compile.includePaths = options.project->includePaths;
    compile.configPlaces = compiler::placesOf(*options.project, compile.config, sources);
  }
  const frontend::Dialect* dialect = dialectOf(sources, files.value(), options);
  if (dialect != nullptr) status = checkNamedConfig(*dialect, *pairs);
  return status == kOk ? std::optional(files.value()) : std::nullopt;
}

namespace {

std::optional<compiler::Compiled> compileFiles(SourceManager& sources, const SourceOptions& options,
                                               compiler::CompileRequest request, bool warnsOfNames, int& status) {
  request.dialect = options.dialect;
  request.keepSource |= warnsOfNames;
  if (options.project) request.name = options.project->name;
  const auto files = addSources(sources, options, request.options, status);
  if (!files) return std::nullopt;
  Diagnostics diagnostics;
  std::optional<compiler::Compiled> compiled = [&] {
    const scenario::Working working("compiling");
    return compiler::compile(sources, *files, request, diagnostics);
  }();
  if (compiled) checkNames(*compiled, sources, request.options, diagnostics);
  if (compiled && warnsOfNames)
    report::reportOddNames(sources, compiled->source->analysis(), *compiled->layout, *compiled->uses,
                           compiled->dialect->shownSpaces, diagnostics);
  if (compiled) compiled->warnings = diagnostics.warningCount();
  if (diagnostics.hasErrors()) compiled.reset();
  printDiagnostics(diagnostics, sources, options);
  status = compiled ? kOk : kWrong;
  return compiled;
}

} // namespace

std::optional<compiler::Compiled> compileSources(SourceManager& sources, const SourceOptions& options,
                                                 compiler::CompileRequest request, int& status) {
  return compileFiles(sources, options, std::move(request), false, status);
}

std::optional<compiler::Compiled> compileChecked(SourceManager& sources, const SourceOptions& options,
                                                 compiler::CompileRequest request, int& status) {
  std::optional<compiler::Compiled> compiled = compileFiles(sources, options, std::move(request), true, status);
  if (compiled) compiled->source.reset(); // it refers to the sources, which may end before
  return compiled;
}

} // namespace rung::rungc
