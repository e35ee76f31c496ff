// TECHNOL in its one style: labels in the first column, instructions, operands and comments in columns of their own.
#pragma once
#include <optional>
#include <string>

#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::frontend::technol {

// A file of a program, or one that is included, laid out anew, in the encoding and with the end mark that it has;
// nothing where its words cannot be read, which is reported.
std::optional<std::string> format(SourceManager& sources, FileId file, Diagnostics& diagnostics);

} // namespace rung::frontend::technol
