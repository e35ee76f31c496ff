// Options and steps of all commands that compile.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <span>
#include <string_view>

#include "compiler/configuration.h"
#include "compiler/dialect_choice.h"
#include "compiler/project.h"
#include "ir/support/diag_render.h"
#include "rtlib/load/file.h"
#include "rtlib/text/controls.h"
#include "tools/rungc/commands.h"
#include "tools/scenario/configuration.h"
#include "tools/scenario/prompt.h"
#include "tools/source/check.h"

namespace rung::rungc {

void addSourceOptions(Command command, SourceOptions& options, const std::string& json) {
  command.option(
      "FILE", options.files,
      "Source files in order (.lad, .mne, .mnc, .pmc, .plc), or the folder of a project; - reads standard input; "
      "default: the project (rung.toml) of the working directory or of a folder above it");
  Option project = command.option("--project", options.projectFile, "Use this project file, or the one in this folder");
  command.flag("--no-project", options.noProject, "Use only the named files, not the project that they belong to")
      .excludes(project);
  command.option("--dialect", options.dialect, "fanuc, gsk, nct or technol; needed if the file does not name it");
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
  std::cout << text; // CommandLine::run reports a failure
  return kOk;
}

namespace {

std::string counted(size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

size_t rungsOf(const ir::Module& module) {
  std::set<uint32_t> numbers; // a drawn rung with calls is several rungs of the module
  for (const ir::Routine& routine : module.routines)
    for (const ir::Rung& rung : routine.rungs) numbers.insert(rung.number);
  numbers.erase(0); // rungs added by the compiler
  return numbers.size();
}

// `rungc check` of the same files with the configuration of the command line.
std::string checkCommand(const SourceOptions& options) {
  std::string command = "rungc check";
  for (const std::string& file : options.project ? std::vector{options.project->file} : options.files)
    command += " " + file;
  for (size_t i = options.project ? options.project->config.size() : 0; i < options.config.size(); ++i)
    command += " --config " + options.config[i];
  return text::withoutControls(command);
}

} // namespace

void printDiagnostics(const Diagnostics& diagnostics, const SourceManager& sources, const SourceOptions& options) {
  if (options.json) {
    std::cout << renderJson(diagnostics, sources) << '\n';
    return;
  }
  const size_t warnings = diagnostics.warningCount();
  RenderOptions render;
  render.color = wantsColor(options.color, STDERR_FILENO);
  render.warnings = options.isCheck || warnings <= kMostWarnings;
  std::cerr << renderText(diagnostics, sources, render);
  if (!render.warnings)
    fmt::print(stderr, "more than {} warnings: `{}` shows all\n", kMostWarnings, checkCommand(options));
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
  Diagnostics discarded; // reported when it is compiled
  return files.empty() ? nullptr : compiler::chooseDialect(sources, files, options.dialect, discarded);
}

// Checks --config; the project's keys have been checked with their positions.
int checkNamedConfig(const frontend::Dialect& dialect, const ConfigPairs& config) {
  int status = kOk;
  for (const compiler::ConfigProblem& problem : scenario::checkConfiguration(dialect, config))
    status = usageError("--config " + problem.text);
  return status;
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
  if (options.project) request.name = options.project->name;
  const auto files = addSources(sources, options, request.options, status);
  if (!files) return std::nullopt;
  Diagnostics diagnostics;
  std::optional<compiler::Compiled> compiled = [&] {
    const scenario::Working working("compiling");
    return warnsOfNames ? source::check(sources, *files, request, diagnostics)
                        : source::compile(sources, *files, request, diagnostics);
  }();
  if (compiled) compiled->warnings = diagnostics.warningCount();
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
  return compileFiles(sources, options, std::move(request), true, status);
}

// Finds the project of a command line, and adds its settings to the options.

namespace {

namespace fs = std::filesystem;

bool isFolder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool isProjectFile(const std::string& path) { return fs::path(path).filename() == compiler::kFileName; }

std::optional<compiler::Project> loadProject(const std::string& file, const SourceOptions& options, int& status) {
  SourceManager sources;
  Diagnostics diagnostics;
  std::optional<compiler::Project> project = source::loadProject(sources, file, diagnostics);
  if (!project || !diagnostics.reported().empty()) printDiagnostics(diagnostics, sources, options);
  if (!project) status = kWrong;
  return project;
}

// Sources that a project cannot list.
bool isOwn(const std::string& file) { return file == "-" || file.ends_with(".so"); }

// Returns the exit status.
int checkKinds(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    if (isOwn(file)) continue; // some commands accept a compiled program
    const std::string other = compiler::otherKind(file, compiler::FileKind::Program);
    if (!other.empty()) return usageError(other);
  }
  return kOk;
}

// The project to which all named files belong. Nothing, with status kOk, if there is none.
std::optional<compiler::Project> projectOfFiles(const SourceOptions& options, int& status) {
  if (std::any_of(options.files.begin(), options.files.end(), isOwn)) return std::nullopt;
  const auto file = compiler::findUpwards(fs::path(options.files[0]).parent_path().string());
  if (!file) return std::nullopt;
  std::optional<compiler::Project> project = loadProject(*file, options, status);
  if (!project) return std::nullopt;
  const bool all = std::all_of(options.files.begin(), options.files.end(),
                               [&](const std::string& name) { return compiler::hasFile(*project, name); });
  return all ? std::move(project) : std::nullopt;
}

// The project of these options; nothing with status kOk if only the files are meant.
std::optional<compiler::Project> projectOf(const SourceOptions& options, int& status) {
  if (!options.projectFile.empty()) return openProject(options.projectFile, options, status);
  if (options.files.empty()) return openProject("", options, status);
  const std::string& first = options.files[0];
  if (options.files.size() == 1 && namesProject(first)) return openProject(first, options, status);
  return projectOfFiles(options, status);
}

// Reports that more than the named files is used.
void sayUse(const SourceOptions& options, const compiler::Project& project) {
  const bool whole = options.files.size() == project.files.size();
  if (options.quiet || options.json || (whole && project.config.empty() && project.includePaths.empty())) return;
  fmt::print(stderr, "rungc: {} {} to the project {}: {} used; --no-project uses only the named files\n",
             options.files.size() == 1 ? options.files[0]
                                       : fmt::format("{} and {} more", options.files[0], options.files.size() - 1),
             options.files.size() == 1 ? "belongs" : "belong", project.file,
             whole ? "its configuration is" : fmt::format("all its {} files are", project.files.size()));
}

bool isSet(const std::vector<std::string>& config, const std::string& key) {
  return std::any_of(config.begin(), config.end(),
                     [&](const std::string& pair) { return pair.starts_with(key + "="); });
}

} // namespace

bool namesProject(const std::string& name) { return isFolder(name) || isProjectFile(name); }

std::optional<compiler::Project> openProject(const std::string& named, const SourceOptions& options, int& status) {
  if (named.empty()) {
    if (const auto found = compiler::findUpwards("")) return loadProject(*found, options, status);
    status = usageError("no file is named, and there is no rung.toml in the working directory or above it; name files, "
                        "or create a project with `rungc new`");
    return std::nullopt;
  }
  const std::string file =
      isFolder(named) ? (fs::path(named) / compiler::kFileName).lexically_normal().string() : named;
  std::error_code error;
  if (fs::is_regular_file(file, error)) return loadProject(file, options, status);
  if (isFolder(named))
    status = usageError(fmt::format("the folder '{}' has no rung.toml: it is not a project", named));
  else
    status = environmentError(fmt::format("cannot read the project file '{}'", named));
  return std::nullopt;
}

int takeProject(SourceOptions& options) {
  if (const int status = checkKinds(options.files); status != kOk) return status;
  if (options.noProject && options.files.empty()) return usageError("--no-project needs the names of source files");
  if (options.noProject) return kOk;
  int status = kOk;
  options.project = projectOf(options, status);
  if (!options.project) return status;
  const compiler::Project& project = *options.project;
  const bool isNamed = !options.files.empty() && !namesProject(options.files[0]);
  if (isNamed && options.projectFile.empty()) sayUse(options, project);
  if (!isNamed || options.projectFile.empty()) options.files = project.files;
  if (options.dialect.empty()) options.dialect = project.dialect;
  std::vector<std::string> config;
  for (const compiler::Setting& setting : project.config)
    if (!isSet(options.config, setting.key)) config.push_back(setting.key + "=" + setting.value);
  options.config.insert(options.config.begin(), config.begin(), config.end());
  return kOk;
}

} // namespace rung::rungc
