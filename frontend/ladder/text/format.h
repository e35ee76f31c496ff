// Formats ladder text. Elements on one line stay on it, in their order; the columns are new.
#pragma once
#include <optional>
#include <string>

#include "frontend/ladder/text/ladder_file.h"

namespace rung::frontend::ladder {

/// A formatted file; nothing if it cannot be read, which is reported. All comments are kept, and the result has the
/// same meaning as the file. A rung for which no new columns are found is left as drawn.
std::optional<std::string> format(const SourceManager& sources, FileId file, FindBox findBox, Diagnostics& diagnostics);

} // namespace rung::frontend::ladder
