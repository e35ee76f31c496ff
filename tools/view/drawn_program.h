// Programs for display, from their files.
#pragma once
#include <optional>
#include <span>

#include "ir/support/source.h"
#include "tools/view/program.h"

namespace rung::view {

// The drawing of a program. Nothing for a program with errors, which are reported: a drawing of its
// correct parts would look like the program.
std::optional<Program> drawnProgram(SourceManager& sources, std::span<const FileId> files,
                                    const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                                    Diagnostics& diagnostics);

} // namespace rung::view
