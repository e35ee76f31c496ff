// rungc format: formats source files in the style of their language.
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <memory>

#include "compiler/dialect_choice.h"
#include "ir/support/check.h"
#include "rtlib/load/file.h"
#include "tools/rungc/commands.h"

namespace rung::rungc {
namespace {

namespace fs = std::filesystem;

struct FormatOptions {
  SourceOptions source;
  bool check = false;
  bool toOutput = false;
};

bool isProject(const std::string& name) {
  std::error_code error;
  return fs::is_directory(name, error) || fs::path(name).filename() == compiler::kFileName;
}

bool isIn(const std::string& name, const std::string& folder) {
  const fs::path relative = fs::path(name).lexically_normal().lexically_relative(folder.empty() ? "." : folder);
  return !relative.empty() && *relative.begin() != "..";
}

// The configuration of the project whose folder contains the file; empty if there is no readable one.
std::map<std::string, std::string> configFor(const std::string& name) {
  const auto found = compiler::findUpwards(fs::path(name).parent_path().string());
  SourceManager sources;
  Diagnostics diagnostics;
  const auto project = found ? compiler::load(sources, *found, diagnostics) : std::nullopt;
  return project ? compiler::configOf(*project) : std::map<std::string, std::string>();
}

// Files in the project's folder that its files include; files elsewhere may belong to other projects.
std::vector<std::string> includedFiles(const compiler::Project& project) {
  const frontend::Dialect& dialect = *frontend::findDialect(project.dialect);
  SourceManager sources;
  const Result<std::vector<FileId>> files = compiler::addFiles(sources, project.files, compiler::configOf(project));
  if (dialect.included == nullptr || !files.ok()) return {}; // a file that cannot be read is reported later
  std::vector<std::string> names = dialect.included(sources, files.value(), {.includePaths = project.includePaths});
  std::erase_if(names, [&](const std::string& name) { return !isIn(name, project.folder); });
  return names;
}

// Takes all files of a project if one is named, or if no file is named; otherwise only the named files.
int takeFiles(SourceOptions& options) {
  const std::vector<std::string>& files = options.files;
  if (!files.empty() && !(files.size() == 1 && isProject(files[0]))) return kOk;
  int status = kOk;
  const auto project = openProject(files.empty() ? "" : files[0], options, status);
  if (!project) return status;
  options.files = project->files;
  std::ranges::copy(includedFiles(*project), std::back_inserter(options.files));
  options.dialect = project->dialect;
  return status;
}

// The dialect of a file that does not determine it, such as an included one: that of the project whose folder contains
// it.
std::string dialectOf(const SourceManager& sources, FileId file, const SourceOptions& options, int& status) {
  if (!options.dialect.empty() || frontend::dialectOf(sources, file) != nullptr) return options.dialect;
  const auto found = compiler::findUpwards(fs::path(sources.name(file)).parent_path().string());
  const auto project = found ? openProject(*found, options, status) : std::nullopt;
  return project ? project->dialect : "";
}

// Nothing if the file has mistakes, which are printed.
std::optional<std::string> formatted(SourceManager& sources, FileId file, const SourceOptions& options, int& status) {
  const std::string name = dialectOf(sources, file, options, status);
  if (status != kOk) return std::nullopt;
  Diagnostics diagnostics;
  const frontend::Dialect* dialect = compiler::chooseDialect(sources, {&file, 1}, name, diagnostics);
  auto text = dialect == nullptr ? std::nullopt : dialect->format(sources, file, diagnostics);
  if (text) return text;
  printDiagnostics(diagnostics, sources, options);
  status = kWrong;
  return std::nullopt;
}

// The file keeps its permissions, and never has wider ones meanwhile.
int replace(const std::string& name, const std::string& text, const SourceOptions& options) {
  std::error_code error;
  const fs::perms mode = fs::status(name, error).permissions() & fs::perms::all;
  const std::string wrong = runtime::replaceFile(name, text, {.mode = static_cast<mode_t>(mode)});
  if (!wrong.empty()) return environmentError(wrong);
  fs::permissions(name, mode, error);
  if (error) return environmentError(fmt::format("cannot restore the mode of '{}': {}", name, error.message()));
  if (!options.quiet) fmt::print("formatted {}\n", name);
  return kOk;
}

int formatFile(const std::string& name, const FormatOptions& options) {
  SourceManager sources;
  const Result<std::vector<FileId>> files = compiler::addFiles(sources, {name}, configFor(name));
  if (!files.ok()) return environmentError(files.error());
  const FileId file = files.value()[0];
  int status = kOk;
  const auto text = formatted(sources, file, options.source, status);
  if (!text) return status;
  const bool changes = *text != sources.text(file);
  if (options.check && changes) fmt::print("{}\n", name);
  if (options.check) return changes ? kWrong : kOk;
  const auto bytes = sources.bytesOf(file, *text);
  RUNG_CHECK(bytes, "a formatter adds no characters");
  if (options.toOutput || name == "-") return writeOutput(*bytes);
  return changes ? replace(name, *bytes, options.source) : kOk;
}

// Formats all files, even if one has mistakes.
int run(FormatOptions options) {
  int status = takeFiles(options.source);
  if (status != kOk) return status;
  for (const std::string& name : options.source.files) status = std::max(status, formatFile(name, options));
  return status;
}

} // namespace

void addFormat(CommandLine& app, int& status) {
  Command command = app.add("format", "Format source files in the standard style of their language");
  auto options = std::make_shared<FormatOptions>();
  command.option(
      "FILE", options->source.files,
      "Source files, also include files, or the folder of a project for all its files; - formats standard input to "
      "standard output; default: the project (rung.toml) of the working directory or of a folder above it");
  Option check = command.flag("--check", options->check,
                              "Write nothing, list the files that would change; exit status 1 if there are any");
  command.flag("--stdout", options->toOutput, "Write to standard output instead of the file").excludes(check);
  command.option("--dialect", options->source.dialect,
                 "fanuc, gsk, nct or technol; needed if the file does not name it");
  command.flag("-q,--quiet", options->source.quiet, "Do not list the changed files");
  addColorOption(command, options->source.color, "Colours in diagnostics");
  command.onRun([options, &status] { status = run(*options); });
}

} // namespace rung::rungc
