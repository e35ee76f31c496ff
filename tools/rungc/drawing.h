// Programs as they are drawn, for the commands that write drawings.
#pragma once
#include <optional>
#include <span>

#include "tools/compiler/compile.h"
#include "tools/view/program.h"

namespace rung::rungc {

// Whether programs of the dialect are ladders.
bool hasDrawing(const frontend::Dialect& dialect);

// A program of a dialect that has drawings. Nothing for one with errors: a drawing of its sound parts would look like
// the program.
std::optional<view::Program> drawingOf(SourceManager& sources, std::span<const FileId> files,
                                       const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                                       Diagnostics& diagnostics);

} // namespace rung::rungc
