// Programs as they are drawn, from their files.
#pragma once
#include <optional>
#include <span>

#include "tools/view/overlay.h"
#include "tools/view/program.h"

namespace rung::view {

// Whether programs of the dialect are ladders.
bool hasDrawing(const frontend::Dialect& dialect);

// A program of a dialect that has drawings. Nothing for one with errors, which are reported: a drawing of its sound
// parts would look like the program.
std::optional<Program> drawnProgram(SourceManager& sources, std::span<const FileId> files,
                                    const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                                    Diagnostics& diagnostics);

// A program of a dialect without drawings; nothing as above.
std::optional<Listing> listedProgram(SourceManager& sources, std::span<const FileId> files,
                                     const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                                     Diagnostics& diagnostics);

} // namespace rung::view
