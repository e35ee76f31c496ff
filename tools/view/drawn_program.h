// Programs for display, from their files: as a drawing, or as a list of rungs.
#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ir/core/module.h"
#include "ir/support/source.h"
#include "tools/view/overlay.h"
#include "tools/view/program.h"

namespace rung::view {

// Whether programs of the dialect have ladder drawings.
bool hasDrawing(const frontend::Dialect& dialect);

// A program of a dialect that has drawings. Nothing for a program with errors, which are reported: a drawing of its
// correct parts would look like the program.
std::optional<Program> drawnProgram(SourceManager& sources, std::span<const FileId> files,
                                    const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                                    Diagnostics& diagnostics);

// A rung of a program that has no drawing.
struct TableRow {
  uint32_t number = 0;
  std::string routine;
  std::string title;
  SourcePlace place;
  uint32_t lastLine = 0;
};
// The numbered rungs of a module in source order.
std::vector<TableRow> rowsOf(const ir::Module& module);

// A program without a drawing.
struct Listing {
  std::string title;
  std::string control;
  std::vector<TableRow> rows;
  std::map<std::string, std::vector<std::string>> texts; // lines by path, without files that cannot be read
};
// `files`: the sources of the program, from `sources`; `included` may name them again.
Listing listingOf(const SourceManager& sources, std::span<const FileId> files, std::string_view control,
                  std::vector<TableRow> rows, const std::vector<std::string>& included);

// A program of a dialect without drawings; nothing for a program with errors.
std::optional<Listing> listedProgram(SourceManager& sources, std::span<const FileId> files,
                                     const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                                     Diagnostics& diagnostics);

} // namespace rung::view
