// Names and operands at a position of the source (see explain.h).
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "compiler/dialect_choice.h"
#include "compiler/reference.h"
#include "rtlib/text/number.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/explain.h"
#include "tools/source/explain.h"
#include "tools/source/plain_text.h"

namespace rung::rungc {
namespace {

// The file by the name that the program uses.
std::optional<FileId> fileOf(const SourceManager& sources, const std::string& path) {
  for (uint32_t i = 0; i < sources.fileCount(); ++i) {
    std::error_code none;
    if (std::filesystem::equivalent(std::string(sources.name(FileId{i})), path, none)) return FileId{i};
  }
  return std::nullopt;
}

// Columns count characters, offsets bytes. The position of a byte order mark counts as the first word.
std::optional<SourcePos> positionOf(const SourceManager& sources, FileId file, const SourcePlace& place) {
  if (place.line == 0 || place.line > sources.lineCount(file)) return std::nullopt;
  const std::string_view line = sources.lineText(file, place.line);
  const auto begin = static_cast<size_t>(line.data() - sources.text(file).data());
  const size_t mark = source::markLength(line);
  for (size_t at = mark; at < line.size(); ++at) {
    const SourcePos position = sources.position(file, begin + at);
    if (sources.lineCol(position).column == place.column || (mark != 0 && at == mark && place.column == 1))
      return position;
  }
  return std::nullopt;
}

} // namespace

std::optional<SourcePlace> sourcePlace(const std::string& word) {
  const size_t last = word.rfind(':');
  const size_t first = last == std::string::npos ? last : word.rfind(':', last - 1);
  if (first == std::string::npos || first == 0) return std::nullopt;
  const auto line = text::numberIn<uint32_t>(std::string_view(word).substr(first + 1, last - first - 1));
  const auto column = text::numberIn<uint32_t>(std::string_view(word).substr(last + 1));
  if (!line || !column) return std::nullopt;
  return SourcePlace{word.substr(0, first), *line, *column};
}

namespace {

// A program, as far as it can be analysed in spite of errors.
class OpenProgram {
public:
  // `options` have been completed by takeProject. On failure false, and `status` says why.
  bool open(const SourceOptions& options, int& status) {
    const auto files = addSources(sources_, options, compile_, status);
    if (!files) return false;
    dialect_ = compiler::chooseDialect(sources_, *files, options.dialect, diagnostics_);
    if (dialect_ == nullptr) {
      printDiagnostics(diagnostics_, sources_, options);
      status = kWrong;
      return false;
    }
    program_ = dialect_->check(sources_, *files, compile_, diagnostics_);
    if (!diagnostics_.hasErrors()) module_ = program_->build();
    if (module_ != nullptr) reference_.emplace(*module_, dialect_->shownSpaces);
    return true;
  }
  const SourceManager& sources() const { return sources_; }
  const frontend::Dialect& dialect() const { return *dialect_; }
  const frontend::Analysis& analysis() const { return program_->analysis(); }
  bool hasErrors() const { return diagnostics_.hasErrors(); }
  source::CheckedText text() const {
    return {sources_, *dialect_, analysis(), diagnostics_, reference_ ? &reference_->get() : nullptr};
  }

private:
  SourceManager sources_;
  Diagnostics diagnostics_;
  frontend::CompileOptions compile_;
  const frontend::Dialect* dialect_ = nullptr;
  std::unique_ptr<frontend::CheckedProgram> program_;
  std::unique_ptr<ir::Module> module_;
  std::optional<report::ModuleReference> reference_;
};

// The program of the project that contains the file, if the program includes the file; otherwise null.
std::unique_ptr<OpenProgram> includingProgram(const std::string& file) {
  const auto projectFile = compiler::findUpwards(std::filesystem::path(file).parent_path().string());
  if (!projectFile) return nullptr;
  SourceOptions options;
  options.projectFile = *projectFile;
  int status = takeProject(options);
  auto program = std::make_unique<OpenProgram>();
  if (status != kOk || !program->open(options, status) || !fileOf(program->sources(), file)) return nullptr;
  return program;
}

} // namespace

std::optional<std::string> explainPlace(const SourcePlace& place, int& status) {
  SourceOptions options;
  options.files = {place.file};
  status = takeProject(options);
  if (status != kOk) return std::nullopt;
  std::unique_ptr<OpenProgram> opened;
  if (!options.project) opened = includingProgram(place.file);
  if (opened == nullptr) {
    opened = std::make_unique<OpenProgram>();
    if (!opened->open(options, status)) return std::nullopt;
  }
  const OpenProgram& program = *opened;
  const SourceManager& sources = program.sources();
  const auto file = fileOf(sources, place.file);
  const auto at = file ? positionOf(sources, *file, place) : std::nullopt;
  if (!at) {
    status = usageError(fmt::format("{} has nothing in line {}, column {}", place.file, place.line, place.column));
    return std::nullopt;
  }
  const source::Explanation found = source::explain(program.text(), *at);
  const bool both = !found.reference.empty() && !found.program.empty();
  return found.errors + (found.reference.empty() ? "" : source::plainText(found.reference)) + (both ? "\n" : "") +
         found.program;
}

std::optional<ProjectNames> namesOfProject(const std::string& word, const std::string& projectFile) {
  if (projectFile.empty() && !compiler::findUpwards("")) return std::nullopt;
  SourceOptions options;
  options.projectFile = projectFile;
  int status = takeProject(options);
  OpenProgram program;
  if (status != kOk || !program.open(options, status)) return std::nullopt;
  ProjectNames names{.dialect = &program.dialect()};
  for (const frontend::Definition& definition : program.analysis().definitions())
    if (definition.range.valid())
      names.entries.push_back({std::string(definition.name), fmt::format("name in {}", options.project->file),
                               compiler::withoutManualLines(definition.comment), ""});
  names.text = source::explainName(program.text(), word);
  names.hasErrors = program.hasErrors();
  return names;
}

} // namespace rung::rungc
