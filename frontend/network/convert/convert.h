// Command lists and ladder text of a language, each to the other, nothing lost (docs/dialects/gsk.md says where a
// comment goes that has no place of its own).
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frontend/network/convert/writers.h"

namespace rung::frontend::network {

// The files of one program without errors in the form `to`. Nothing when a network is too large to be drawn; that
// is in `diagnostics`.
std::optional<std::string> convertProgram(const Language& language, SourceManager& sources,
                                          std::span<const FileId> files, Form to, Diagnostics& diagnostics);

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

// Of such a program: its own files, or what they are converted to when there is a list among them.
std::optional<LadderForm> ladderForm(const Language& language, SourceManager& sources, std::span<const FileId> files,
                                     Diagnostics& diagnostics);

} // namespace rung::frontend::network
