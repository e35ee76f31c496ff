// A program as a host would see it, for commands that look its names up.
#pragma once
#include <memory>
#include <optional>

#include "compiler/compile.h"
#include "rtlib/load/engine.h"
#include "rung/runtime.hpp"
#include "tools/rungc/commands.h"

namespace rung::rungc {

// What is compiled ends after the image.
struct OpenedProgram {
  std::optional<compiler::Compiled> compiled; // nothing of a shared object
  std::unique_ptr<runtime::Engine> engine;
  std::unique_ptr<Image> image; // never null
};

// Of sources, or of a shared object; nothing, and `status` says why, when it cannot be had.
std::optional<OpenedProgram> openProgram(const SourceOptions& source, int& status);

} // namespace rung::rungc
