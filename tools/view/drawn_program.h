// Programs as they are shown, from their files: as a drawing, or as a list of their rungs.
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

// Whether programs of the dialect are ladders.
bool hasDrawing(const frontend::Dialect& dialect);

// A program of a dialect that has drawings. Nothing for one with errors, which are reported: a drawing of its sound
// parts would look like the program.
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
// The numbered rungs of a module in the order in which the source has them.
std::vector<TableRow> rowsOf(const ir::Module& module);

// A program without a drawing, as it is read.
struct Listing {
  std::string title;
  std::string control;
  std::vector<TableRow> rows;
  std::map<std::string, std::vector<std::string>> texts; // lines, by path; a file that cannot be read is not there
};
// `files` are those that the program has been made of, from `sources`; `included` may name them again.
Listing listingOf(const SourceManager& sources, std::span<const FileId> files, std::string_view control,
                  std::vector<TableRow> rows, const std::vector<std::string>& included);

// A program of a dialect without drawings; nothing as above.
std::optional<Listing> listedProgram(SourceManager& sources, std::span<const FileId> files,
                                     const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                                     Diagnostics& diagnostics);

} // namespace rung::view
