// Formats mnemonic files.
#pragma once
#include <optional>
#include <string>

#include "frontend/network/language.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::frontend::fanuc {

inline constexpr size_t kCommentColumn = 24;
inline constexpr size_t kOperandColumn = 11; // after the longest command

// A mnemonic file with commands in capitals and operands in a column; parameters and sections other than the ladder
// stay as they are. Nothing for a file that is not a text, which is reported.
std::optional<std::string> formatMnemonic(const network::Language& language, SourceManager& sources, FileId file,
                                          Diagnostics& diagnostics);

} // namespace rung::frontend::fanuc
