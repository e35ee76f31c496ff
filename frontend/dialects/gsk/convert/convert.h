// Command lists and ladder text of this dialect, each to the other, nothing lost (docs/dialects/gsk.md says where a
// comment goes that has no place of its own).
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "frontend/dialects/gsk/convert/gap_writer.h"

namespace rung::gsk {

// The files of one program in the form `to`. Nothing where the program has errors; they are in `diagnostics`.
std::optional<std::string> convertProgram(SourceManager& sources, std::span<const FileId> files,
                                          const frontend::CompileOptions& options, convert::Form to,
                                          Diagnostics& diagnostics);

// An element of a conversion begins at `drawn`; its author wrote it at `written`.
struct Origin {
  SourcePos drawn;
  SourcePos written;
};

// A program as ladder text alone.
struct LadderForm {
  std::vector<FileId> files;
  // Of a conversion: where the rungs of its one file, and their contacts, coils and boxes, are in the author's files.
  std::vector<SourceRange> networks;
  std::vector<Origin> elements; // by `drawn`
};

// Of a program that was compiled without errors: its own files, or what they are converted to when there is a list
// among them. Nothing when a network is too large to be drawn; that is in `diagnostics`.
std::optional<LadderForm> ladderForm(SourceManager& sources, std::span<const FileId> files,
                                     const frontend::CompileOptions& options, Diagnostics& diagnostics);

} // namespace rung::gsk
