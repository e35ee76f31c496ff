// Sources as UTF-8, whatever they were written in: UTF-8, Windows-1250 or CP852, detected or as `encoding` says. A byte
// becomes one character, so that lines and columns stay.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::frontend::technol {

enum class Encoding : uint8_t { Detect, Utf8, Windows1250, Cp852 };

// utf-8, windows-1250, cp852; everything else: Detect.
Encoding encodingNamed(std::string_view name);

// The file itself, or a decoded copy of the same name. Nothing after a report (bad-encoding).
std::optional<FileId> readable(SourceManager& sources, FileId file, Encoding encoding, Diagnostics& diagnostics);

// Without the mark that DOS editors close a text with, and line ends after it.
std::string_view withoutEndMark(std::string_view text);

// The byte of a text of one character; nothing when it is not a single character of Windows-1250.
std::optional<uint8_t> characterByte(std::string_view text);

} // namespace rung::frontend::technol
