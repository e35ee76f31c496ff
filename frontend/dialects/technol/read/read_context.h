// Shared by the readers of a program's files: the parts that they fill, and counts over all files.
#pragma once

#include "frontend/dialects/technol/program.h"

namespace rung::frontend::technol {

// Options from the configuration.
struct ReadOptions {
  std::string systemFolder;              // for included files named without a path; may be empty
  std::vector<std::string> includePaths; // searched after the folders of the program and of the including file
};

struct ReadContext {
  SourceManager& sources; // included files are added
  const ReadOptions& options;
  Diagnostics& diagnostics;
  SourceProgram& program;
  Declarations& declarations;
  Symbols& symbols;

  // Decoded included files, by path: each is decoded once, so that a mistake in it is reported at one position.
  // Nothing: it cannot be read.
  std::unordered_map<std::string, std::optional<FileId>> includes = {};
  uint32_t included = 0; // number of files read by T_INCLUDE
  uint32_t expanded = 0; // number of lines made by macros

  DiagBuilder report(Diag id, SourceRange at) { return diagnostics.report(id, at); }
};

} // namespace rung::frontend::technol
