// Ladder text in its one style. What is drawn on a line stays on it, in its order; the columns are new.
#pragma once
#include <optional>
#include <string>

#include "frontend/ladder/text/ladder_file.h"

namespace rung::frontend::ladder {

/// A file laid out anew; nothing where it cannot be read, which is reported. All comments are kept, and what is read
/// from the result is what is read from the file. A rung that no new columns are found for stays as it is drawn.
std::optional<std::string> format(const SourceManager& sources, FileId file, FindBox findBox, Diagnostics& diagnostics);

} // namespace rung::frontend::ladder
