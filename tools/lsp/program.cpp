// See program.h.
#include "tools/lsp/program.h"

#include <utility>

#include "compiler/dialect_choice.h"
#include "ir/support/result.h"
#include "tools/lsp/uri.h"
#include "tools/source/check.h"

namespace rung::lsp {
namespace {

compiler::CompileRequest requestOf(const compiler::Project& project, SourceManager& sources) {
  compiler::CompileRequest request{.dialect = project.dialect, .name = project.name};
  request.options.config = compiler::configOf(project);
  request.options.includePaths = project.includePaths;
  request.options.configPlaces = compiler::placesOf(project, request.options.config, sources);
  return request;
}

} // namespace

void Program::check(const OpenTexts& open) {
  ++checks_;
  reference_.reset();
  image_.reset();
  compiled_.reset();
  text_.reset();
  dialect_ = nullptr;
  failure_.clear();
  diagnostics_ = {};
  projectDiagnostics_ = {};
  sources_ = {};
  projectSources_ = {};
  sources_.setOpenTexts(open);
  projectSources_.setOpenTexts(open);
  if (!isProject_) return checkFiles({path_}, {});
  const std::optional<compiler::Project> project = source::loadProject(projectSources_, path_, projectDiagnostics_);
  if (project) checkFiles(project->files, requestOf(*project, sources_));
}

void Program::checkFiles(std::vector<std::string> names, compiler::CompileRequest request) {
  const Result<std::vector<FileId>> files = compiler::addFiles(sources_, names, request.options.config);
  if (!files.ok()) {
    failure_ = files.error();
    return;
  }
  Diagnostics again; // the same is reported when it is compiled
  dialect_ = compiler::chooseDialect(sources_, files.value(), request.dialect, again);
  request.optimise = false;
  request.source = &text_;
  const auto checked = contained([&]() -> Result<bool> {
    compiled_ = source::check(sources_, files.value(), std::move(request), diagnostics_);
    return true;
  });
  if (!checked.ok()) failure_ = checked.error();
}

std::optional<source::CheckedText> Program::text() {
  if (text_ == nullptr) return std::nullopt;
  if (compiled_ && reference_ == nullptr) {
    image_ = std::make_unique<ir::ProgramImage>(*compiled_->layout, compiled_->codeHash);
    reference_ = std::make_unique<report::CrossReference>(image_->program(), *compiled_->uses, dialect_->shownSpaces);
  }
  return source::CheckedText{sources_, *dialect_, text_->analysis(), diagnostics_, reference_.get()};
}

std::optional<FileId> Program::fileOf(const std::string& path) const {
  for (uint32_t i = 0; i < sources_.fileCount(); ++i)
    if (pathOf(sources_, FileId{i}) == path) return FileId{i};
  return std::nullopt;
}

} // namespace rung::lsp
