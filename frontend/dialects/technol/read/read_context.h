// What the readers of a program's files share: the parts that they fill, and what counts over all files.
#pragma once

#include "frontend/dialects/technol/program.h"

namespace rung::frontend::technol {

// Of the configuration.
struct ReadOptions {
  std::string systemFolder;              // of included files named without a path; may be empty
  std::vector<std::string> includePaths; // looked through after the folders of the program and of the including file
};

struct ReadContext {
  SourceManager& sources; // included files are added
  const ReadOptions& options;
  Diagnostics& diagnostics;
  SourceProgram& program;
  Declarations& declarations;
  Symbols& symbols;

  // Files that were included, by path, as they are read: once, so that a mistake in one has one place. Nothing: no
  // text.
  std::unordered_map<std::string, std::optional<FileId>> includes = {};
  uint32_t included = 0; // files by T_INCLUDE
  uint32_t expanded = 0; // lines of macros

  DiagBuilder report(Diag id, SourceRange at) { return diagnostics.report(id, at); }
};

} // namespace rung::frontend::technol
