// TECHNOL in its one style: labels in the first column, instructions, operands and comments in columns of their own.
#pragma once
#include <optional>
#include <span>
#include <string>

#include "ir/core/module.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::frontend::technol {

// A file of a program, or one that is included, laid out anew, in the encoding and with the end mark that it has;
// nothing where its words cannot be read, which is reported.
std::optional<std::string> format(SourceManager& sources, FileId file, Diagnostics& diagnostics);

// The control listing of a program: its lines with the numbers that the cells name_LINE of mechanisms show (man.
// l.2210).

// Each file with its name above it; the lines count from 1 in each, as name_LINE and the diagnostics do. Texts keep the
// encoding of their source; included files are not shown, their lines have no number of the program. A second column
// has the number of the rung that begins in the line, as profiles and faults name it; `module` is what the files
// compile to.
std::string listing(const SourceManager& sources, std::span<const FileId> files, const ir::Module& module);

} // namespace rung::frontend::technol
