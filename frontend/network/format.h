// Both source forms of a language in their one style.
#pragma once
#include <optional>
#include <string>

#include "frontend/network/language.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::frontend::network {

// A file laid out anew, ladder text or a command list; nothing where it cannot be read, which is reported.
std::optional<std::string> format(const Language& language, SourceManager& sources, FileId file,
                                  Diagnostics& diagnostics);

} // namespace rung::frontend::network
