// Formats TECHNOL: labels in the first column, and separate columns for instructions, operands and comments.
#pragma once
#include <optional>
#include <span>
#include <string>

#include "ir/core/module.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::frontend::technol {

// A formatted file of a program, or an included one, with its encoding and end mark; nothing if it cannot be read,
// which is reported.
std::optional<std::string> format(SourceManager& sources, FileId file, Diagnostics& diagnostics);

// The control listing of a program: its lines with the numbers that the cells name_LINE of mechanisms show (man.
// l.2210).

// Each file follows its name; lines are numbered from 1 in each, as in name_LINE and diagnostics. Texts keep the
// encoding of their source; included files are not shown, because their lines have no number in the program. A second
// column has the number of the rung that begins in the line, as in profiles and faults; `module` is compiled from the
// files.
std::string listing(const SourceManager& sources, std::span<const FileId> files, const ir::Module& module);

} // namespace rung::frontend::technol
