// Formats both source forms of a language.
#pragma once
#include <optional>
#include <string>

#include "frontend/network/language.h"
#include "frontend/network/program.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::frontend::network {

inline constexpr size_t kCommentColumn = 18; // of the comments in a command list

// A command of a list with its operand.
std::string listCommand(const Language& language, const Written& command, bool begins);
// A command list, one statement a line.
std::optional<std::string> formatList(const Language& language, SourceManager& sources, FileId file,
                                      Diagnostics& diagnostics);
// A formatted file, ladder text or a command list; nothing if it cannot be read, which is reported.
std::optional<std::string> format(const Language& language, SourceManager& sources, FileId file,
                                  Diagnostics& diagnostics);

} // namespace rung::frontend::network
