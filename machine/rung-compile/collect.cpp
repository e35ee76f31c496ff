// See collect.h. The front end determines the files: every file that it opens is collected.
#include "machine/rung-compile/collect.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

#include "compiler/dialect_choice.h"
#include "compiler/project.h"
#include "frontend/dialects/dialect.h"
#include "ir/support/diag_render.h"

namespace rung::rung_compile {
namespace {

namespace fs = std::filesystem;

std::string tooLarge(uintmax_t bytes) {
  return fmt::format("the sources have {} bytes, expected at most {}", bytes, compile::kMostBytes);
}

std::string textOf(const Diagnostics& diagnostics, const SourceManager& sources, bool color) {
  return renderText(diagnostics, sources, {.color = color}) + closingLine(diagnostics);
}

// Collects one set of sources; `result_` is the result.
class Collector {
public:
  explicit Collector(bool color) : color_(color) {}

  Collected collect(const std::vector<std::string>& names) {
    if (!findProject(names)) return std::move(result_);
    compile::Sources sources;
    frontend::CompileOptions options;
    if (project_) takeProject(sources, options);
    sources.files = project_ ? project_->files : names;
    if (!compile(sources, options)) return std::move(result_);
    for (uint32_t file = 0; file < sources_.fileCount(); ++file)
      sources.texts.emplace(sources_.name(FileId{file}), sources_.text(FileId{file}));
    result_.sources = std::move(sources);
    return std::move(result_);
  }

private:
  bool fail(std::string report) {
    result_.report = std::move(report);
    return false;
  }

  bool load(const std::string& file) {
    SourceManager texts;
    Diagnostics diagnostics;
    project_ = compiler::load(texts, file, diagnostics);
    if (project_) return true;
    result_.diagnostics = renderJson(diagnostics, texts);
    return fail(textOf(diagnostics, texts, color_));
  }

  // Returns false if there is a project that cannot be used.
  bool findProject(const std::vector<std::string>& names) {
    const fs::path first = names.front();
    std::error_code error;
    if (names.size() == 1 && fs::is_directory(first, error))
      return load((first / compiler::kFileName).lexically_normal().string());
    if (names.size() == 1 && first.filename() == compiler::kFileName) return load(names.front());
    const auto file = compiler::findUpwards(first.parent_path().string());
    if (!file) return true;
    if (!load(*file)) return false;
    if (!std::ranges::all_of(names, [&](const std::string& name) { return compiler::hasFile(*project_, name); }))
      project_.reset();
    return true;
  }

  void takeProject(compile::Sources& sources, frontend::CompileOptions& options) {
    sources.dialect = project_->dialect;
    sources.name = project_->name;
    sources.includePaths = project_->includePaths;
    for (const compiler::Setting& setting : project_->config) sources.config[setting.key] = setting.value;
    options.config = sources.config;
    options.includePaths = sources.includePaths;
    const auto encoding = sources.config.find(std::string(nc::kEncodingKey.key));
    if (encoding == sources.config.end()) return;
    sources_.setEncoding(encoding->second);
    sources.config.erase(encoding); // collected texts are UTF-8
  }

  // Reads all files.
  bool compile(const compile::Sources& sources, frontend::CompileOptions& options) {
    std::vector<FileId> files;
    for (const std::string& name : sources.files) {
      std::error_code error; // for files without a size, such as pipes
      if (const uintmax_t bytes = fs::file_size(name, error); !error && bytes > compile::kMostBytes)
        return fail(tooLarge(bytes));
      const Result<FileId> file = sources_.addFile(name);
      result_.unreadable = !file.ok();
      if (!file.ok()) return fail(fmt::format("cannot read '{}': {}", name, file.error()));
      files.push_back(file.value());
    }
    if (project_) options.configPlaces = compiler::placesOf(*project_, sources.config, sources_);
    Diagnostics diagnostics;
    const frontend::Dialect* dialect = compiler::chooseDialect(sources_, files, sources.dialect, diagnostics);
    if (dialect != nullptr) dialect->compile(sources_, files, options, diagnostics);
    if (!diagnostics.hasErrors()) return true;
    result_.diagnostics = renderJson(diagnostics, sources_);
    return fail(textOf(diagnostics, sources_, color_));
  }

  bool color_;
  SourceManager sources_;
  std::optional<compiler::Project> project_;
  Collected result_;
};

} // namespace

Collected collect(const std::vector<std::string>& names, bool color) {
  Collected result = Collector(color).collect(names);
  if (!result.sources) return result;
  const size_t bytes = compile::packed(*result.sources).size();
  const size_t files = result.sources->texts.size();
  if (bytes > compile::kMostBytes)
    result.report = tooLarge(bytes);
  else if (files > compile::kMostFiles)
    result.report = fmt::format("the program has {} files, expected at most {}", files, compile::kMostFiles);
  if (!result.report.empty()) result.sources.reset();
  return result;
}

} // namespace rung::rung_compile
