// Command lists and ladder text of this dialect, each to the other, nothing lost (docs/dialects/gsk.md tells where a
// comment goes that has no place of its own).
#pragma once
#include <optional>
#include <span>
#include <string>

#include "frontend/dialects/dialect.h"
#include "frontend/dialects/gsk/convert/gap_writer.h"

namespace rung::gsk {

// The files of one program in the form `to`. Nothing where the program has errors; they stand in `diagnostics`.
std::optional<std::string> convertProgram(SourceManager& sources, std::span<const FileId> files,
                                          const frontend::CompileOptions& options, convert::Form to,
                                          Diagnostics& diagnostics);

} // namespace rung::gsk
