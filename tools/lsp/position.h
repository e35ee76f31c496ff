// Places in texts as the protocol counts them: lines and columns from 0, columns in a unit that both sides have agreed
// on.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ir/support/source.h"

namespace rung::lsp {

enum class Unit : uint8_t { Utf8, Utf16, Utf32 };

struct Position {
  uint32_t line = 0;
  uint32_t character = 0;
  bool operator==(const Position&) const = default;
};

struct Range {
  Position begin;
  Position end;
  bool operator==(const Range&) const = default;
};

// The units of a text, and the bytes of its first `units`: at most the whole text, and no part of a character.
uint32_t unitsOf(std::string_view text, Unit unit);
size_t bytesOf(std::string_view text, uint32_t units, Unit unit);

// The offset in a text; a place beyond the end of a line, or of the text, is that end.
size_t offsetOf(std::string_view text, Position position, Unit unit);

// The same for files of a program. The range must be valid.
Position positionOf(const SourceManager& sources, SourcePos at, Unit unit);
Range rangeOf(const SourceManager& sources, SourceRange range, Unit unit);
SourcePos posOf(const SourceManager& sources, FileId file, Position position, Unit unit);

} // namespace rung::lsp
