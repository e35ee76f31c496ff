// Converts between command lists and ladder text of a language, without loss (docs/dialects/gsk.md says where a comment
// goes that has no position of its own).
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frontend/network/convert/writers.h"

namespace rung::frontend::network {

// The files of one program without errors in the form `to`. Nothing if a network is too large to be drawn; that is
// reported.
std::optional<std::string> convertProgram(const Language& language, SourceManager& sources,
                                          std::span<const FileId> files, Form to, Diagnostics& diagnostics);

// An element of a conversion begins at `drawn`; its author wrote it at `written`.
struct Origin {
  SourcePos drawn;
  SourcePos written;
};

// A program as ladder text only.
struct LadderForm {
  std::vector<FileId> files;
  // For a conversion: the positions in the author's files of the rungs of its one file, and of their contacts, coils
  // and boxes.
  std::vector<SourceRange> networks;
  std::vector<Origin> elements; // by `drawn`
};

// For a program without errors: its own files, or their conversion if there is a list among them.
std::optional<LadderForm> ladderForm(const Language& language, SourceManager& sources, std::span<const FileId> files,
                                     Diagnostics& diagnostics);

} // namespace rung::frontend::network
