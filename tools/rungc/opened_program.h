// A program as a host sees it, for commands that look its names up.
#pragma once
#include <memory>
#include <optional>

#include "compiler/compile.h"
#include "rtlib/load/engine.h"
#include "rung/runtime.hpp"
#include "tools/rungc/commands.h"

namespace rung::rungc {

// The image must be destroyed before the program that was compiled for it.
struct OpenedProgram {
  std::optional<compiler::Compiled> compiled; // nothing for a shared object
  std::unique_ptr<runtime::Engine> engine;
  std::unique_ptr<Image> image; // never null
};

// From sources, or from a shared object; on failure nothing, and `status` says why.
std::optional<OpenedProgram> openProgram(const SourceOptions& source, int& status);

} // namespace rung::rungc
