// The project of a command line: which one it is, and what it adds to the options.
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

#include "compiler/configuration.h"
#include "compiler/project.h"
#include "tools/rungc/commands.h"
#include "tools/scenario/configuration.h"

namespace rung::rungc {
namespace {

namespace fs = std::filesystem;

bool isFolder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool isProjectFile(const std::string& path) { return fs::path(path).filename() == compiler::kFileName; }

void checkSettings(const compiler::Project& project, const SourceManager& sources, Diagnostics& diagnostics) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const compiler::Setting& setting : project.config) pairs.emplace_back(setting.key, setting.value);
  const frontend::Dialect& dialect = *frontend::findDialect(project.dialect);
  for (const compiler::ConfigProblem& problem : scenario::checkConfiguration(dialect, pairs)) {
    const auto setting = std::find_if(project.config.begin(), project.config.end(),
                                      [&](const compiler::Setting& s) { return s.key == problem.key; });
    compiler::report(problem, dialect, sources.range(FileId{0}, setting->begin, setting->end), diagnostics);
  }
}

std::optional<compiler::Project> loadProject(const std::string& file, const SourceOptions& options, int& status) {
  SourceManager sources;
  Diagnostics diagnostics;
  std::optional<compiler::Project> project = compiler::load(sources, file, diagnostics);
  if (project) checkSettings(*project, sources, diagnostics);
  if (diagnostics.hasErrors()) project.reset();
  if (!project || !diagnostics.reported().empty()) printDiagnostics(diagnostics, sources, options);
  if (!project) status = kWrong;
  return project;
}

// Sources that no project can list.
bool isOwn(const std::string& file) { return file == "-" || file.ends_with(".so"); }

// Gives the exit status.
int checkKinds(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    if (isOwn(file)) continue; // a compiled program some commands take
    const std::string other = compiler::otherKind(file, compiler::FileKind::Program);
    if (!other.empty()) return usageError(other);
  }
  return kOk;
}

// The project that all the named files belong to. Nothing, with status kOk, when there is none.
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

// The project of these options; nothing with status kOk when the files are meant alone.
std::optional<compiler::Project> projectOf(const SourceOptions& options, int& status) {
  if (!options.projectFile.empty()) return openProject(options.projectFile, options, status);
  if (options.files.empty()) return openProject("", options, status);
  const std::string& first = options.files[0];
  if (options.files.size() == 1 && namesProject(first)) return openProject(first, options, status);
  return projectOfFiles(options, status);
}

// Says that more than what was named is used.
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
