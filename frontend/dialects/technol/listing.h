// The control listing of a program: its lines with the numbers that the cells name_LINE of mechanisms show (man.
// l.2210).
#pragma once

#include <span>
#include <string>

#include "ir/core/module.h"
#include "ir/support/source.h"

namespace rung::frontend::technol {

// Each file with its name above it; the lines count from 1 in each, as name_LINE and the diagnostics do. Texts keep the
// encoding of their source; included files are not shown, their lines have no number of the program. A second column
// has the number of the rung that begins in the line, as profiles and faults name it; `module` is what the files
// compile to.
std::string listing(const SourceManager& sources, std::span<const FileId> files, const ir::Module& module);

} // namespace rung::frontend::technol
