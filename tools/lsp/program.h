// A program while it is written: checked as its texts are now, with what was understood where it has errors.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compiler/compile.h"
#include "compiler/project.h"
#include "ir/image/program_image.h"
#include "ir/shape/layout.h"
#include "tools/report/cross_reference.h"
#include "tools/source/explain.h"

namespace rung::lsp {

// Texts that an editor has open, by the paths of their files.
using OpenTexts = std::map<std::string, std::string>;

class Program {
public:
  // Of a project file, or of a single file that belongs to none.
  Program(std::string path, bool isProject) : path_(std::move(path)), isProject_(isProject) {}
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  const std::string& path() const { return path_; }
  bool isProject() const { return isProject_; }

  // `open` must outlive the program, or its next check.
  void check(const OpenTexts& open);
  // How often it was checked.
  uint64_t checks() const { return checks_; }

  // Valid until the next check.
  const SourceManager& sources() const { return sources_; }
  const Diagnostics& diagnostics() const { return diagnostics_; }
  // Of the project file, which has sources of its own.
  const SourceManager& projectSources() const { return projectSources_; }
  const Diagnostics& projectDiagnostics() const { return projectDiagnostics_; }
  // What nothing could be checked for, such as a file that cannot be read; "": nothing.
  const std::string& failure() const { return failure_; }
  // Null if not even the dialect is known.
  const frontend::Dialect* dialect() const { return dialect_; }
  const frontend::Analysis* analysis() const { return text_ == nullptr ? nullptr : &text_->analysis(); }
  // Nothing without an analysis.
  std::optional<source::CheckedText> text();
  // By the path of a file; nothing if the program does not have it.
  std::optional<FileId> fileOf(const std::string& path) const;

private:
  void checkFiles(std::vector<std::string> names, compiler::CompileRequest request);

  std::string path_;
  bool isProject_;
  uint64_t checks_ = 0;
  SourceManager projectSources_;
  Diagnostics projectDiagnostics_;
  std::string failure_;
  SourceManager sources_;
  Diagnostics diagnostics_;
  const frontend::Dialect* dialect_ = nullptr;
  std::unique_ptr<const frontend::CheckedProgram> text_;
  std::optional<compiler::Compiled> compiled_;
  std::unique_ptr<const ir::ProgramImage> image_;
  std::unique_ptr<const report::CrossReference> reference_; // made when it is first needed
};

} // namespace rung::lsp
