// Which dialect the files of a program have, and what a file is that is not one of a program.
#pragma once
#include <span>
#include <string>

#include "frontend/dialects/dialect.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::compiler {

// The dialect of a program: the named one, or with an empty name that of the first file. Null if it cannot be
// determined, or if a file is not a source of a program; that is reported.
const frontend::Dialect* chooseDialect(const SourceManager& sources, std::span<const FileId> files,
                                       const std::string& name, Diagnostics& diagnostics);

} // namespace rung::compiler
