// Sources as UTF-8. Those that do not say what they are written in are UTF-8, Windows-1250 or CP852, found out by their
// letters. A byte becomes one character, so that lines and columns stay.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "frontend/dialects/technol/read/lexer.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::frontend::technol {

// The file itself, or a decoded copy of the same name. Nothing after a report (bad-encoding).
std::optional<FileId> readable(SourceManager& sources, FileId file, Diagnostics& diagnostics);

// The byte of a text of one character; nothing when it is not a single character of Windows-1250.
std::optional<uint8_t> characterByte(std::string_view text);

// Reports each character of a text that Windows-1250 lacks; true: there is none.
bool checkCharacters(const Token& text, Diagnostics& diagnostics);
// The text as the memory holds it, after these reports.
std::string memoryText(const Token& text, Diagnostics& diagnostics);

} // namespace rung::frontend::technol
