// Both source forms of this dialect in their one style.
#pragma once
#include <optional>
#include <string>

#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::gsk {

// A file laid out anew, ladder text or a command list; nothing where it cannot be read, which is reported.
std::optional<std::string> format(SourceManager& sources, FileId file, Diagnostics& diagnostics);

} // namespace rung::gsk
