// Programs and projects, checked with everything that `rungc check` says of them.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "compiler/compile.h"
#include "compiler/project.h"

namespace rung::source {

// compiler::compile, and what is known only then of the names in the configuration.
std::optional<compiler::Compiled> compile(SourceManager& sources, std::span<const FileId> files,
                                          const compiler::CompileRequest& request, Diagnostics& diagnostics);
// The same with warnings of names that look like mistakes.
std::optional<compiler::Compiled> check(SourceManager& sources, std::span<const FileId> files,
                                        compiler::CompileRequest request, Diagnostics& diagnostics);

// compiler::load, which also checks the configuration. `sources` must be empty.
std::optional<compiler::Project> loadProject(SourceManager& sources, const std::string& file, Diagnostics& diagnostics);

} // namespace rung::source
