// From a checked program to a module of the IR: spaces, tasks, schedule, symbols, and the rungs of all bodies.
#pragma once
#include <memory>

#include "frontend/dialects/dialect.h"
#include "frontend/dialects/nct/program.h"
#include "ir/core/module.h"

namespace rung::frontend::nct {

// The texts of the source.
struct Texts {
  std::vector<ir::MessageText> messages; // and titles of buttons, see nct.h
};

std::unique_ptr<ir::Module> buildModule(const Program& program, Symbols& symbols, const Texts& texts,
                                        const SourceManager& sources, std::span<const FileId> files,
                                        const frontend::CompileOptions& options);

} // namespace rung::frontend::nct
