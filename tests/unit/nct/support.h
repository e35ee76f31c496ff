// Compiling NCT programs in tests.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "frontend/dialects/dialect.h"

namespace rung::frontend::nct::test {

struct Compiled {
  std::unique_ptr<ir::Module> module;
  SourceManager sources;
  Diagnostics diagnostics;
  // "LINE:COLUMN code" of every diagnostic, by position; warnings as "LINE:COLUMN code (w)".
  std::vector<std::string> codes() const;
  std::string rendered() const;
};

using Options = frontend::CompileOptions;

// A whole file.
Compiled compileFile(std::string text, const Options& options = {});
// Rungs and declarations in module MAIN: line 1 of `body` is line 3 of the file.
Compiled compileMain(std::string_view body, const Options& options = {});
inline constexpr int kBodyLine = 3;

} // namespace rung::frontend::nct::test
