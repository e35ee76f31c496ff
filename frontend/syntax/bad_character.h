// Characters that mean nothing outside comments and texts.
#pragma once
#include <string_view>

#include "ir/support/diagnostics.h"

namespace rung::frontend {

/// Reports the character at `offset` of a text that begins at `begin`. One that only looks like an ASCII character (of
/// another alphabet, of a word processor, full width) is put right by a fix.
void reportBadCharacter(std::string_view text, size_t offset, SourcePos begin, Diagnostics& diagnostics);

/// The look-alike's part of the report, where the character is one.
void noteLookAlike(std::string_view text, size_t offset, SourcePos begin, DiagBuilder& report);

} // namespace rung::frontend
