// A program without errors, with everything that its author wrote. Both forms are read to it and written from it.
#pragma once
#include <span>

#include "frontend/network/program.h"

namespace rung::frontend::network {

struct SourceProgram {
  const SourceManager& sources;
  Program program;
  Gap preamble; // up to the last declaration before all networks; with the one Dialect
  Gap tail;     // after all networks
};

SourceProgram readSource(const Language& language, SourceManager& sources, std::span<const FileId> files);

} // namespace rung::frontend::network
