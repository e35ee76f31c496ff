// The drawing of a compiled program, for tests of the live page.
#pragma once
#include <gtest/gtest.h>

#include <utility>

#include "compiler/compile.h"
#include "tools/view/drawn_program.h"

namespace rung::web {

inline view::Program drawingOf(const compiler::Compiled& compiled) {
  SourceManager sources;
  const auto files = compiler::addFiles(sources, compiled.module->files, compiled.options.config);
  EXPECT_TRUE(files.ok());
  frontend::CompileOptions options = compiled.options;
  options.configPlaces.clear();
  Diagnostics diagnostics;
  auto drawing = view::drawnProgram(sources, files.value(), *compiled.dialect, options, diagnostics);
  EXPECT_TRUE(drawing.has_value());
  return std::move(*drawing);
}

} // namespace rung::web
