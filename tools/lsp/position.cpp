// See position.h.
#include "tools/lsp/position.h"

#include <algorithm>

#include "ir/support/utf8.h"

namespace rung::lsp {
namespace {

uint32_t unitsOfCharacter(const CodePoint& character, Unit unit) {
  switch (unit) {
  case Unit::Utf8: return character.length;
  case Unit::Utf16: return character.value > 0xFFFF ? 2 : 1;
  case Unit::Utf32: break;
  }
  return 1;
}

std::string_view withoutLineEnd(std::string_view line) {
  if (line.ends_with('\n')) line.remove_suffix(1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

} // namespace

uint32_t unitsOf(std::string_view text, Unit unit) {
  uint32_t units = 0;
  for (size_t at = 0; at < text.size();) {
    const CodePoint character = decodeUtf8(text, at);
    units += unitsOfCharacter(character, unit);
    at += character.length;
  }
  return units;
}

size_t bytesOf(std::string_view text, uint32_t units, Unit unit) {
  size_t at = 0;
  while (at < text.size()) {
    const CodePoint character = decodeUtf8(text, at);
    const uint32_t needed = unitsOfCharacter(character, unit);
    if (needed > units) break;
    units -= needed;
    at += character.length;
  }
  return at;
}

size_t offsetOf(std::string_view text, Position position, Unit unit) {
  size_t begin = 0;
  for (uint32_t line = 0; line < position.line; ++line) {
    const size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) return text.size();
    begin = end + 1;
  }
  const size_t end = std::min(text.find('\n', begin), text.size());
  return begin + bytesOf(withoutLineEnd(text.substr(begin, end - begin)), position.character, unit);
}

Position positionOf(const SourceManager& sources, SourcePos at, Unit unit) {
  const SourceManager::LineStart start = sources.lineStart(at);
  const std::string_view before = sources.text(start.file).substr(start.offset, sources.offsetOf(at) - start.offset);
  return {start.line - 1, unitsOf(before, unit)};
}

Range rangeOf(const SourceManager& sources, SourceRange range, Unit unit) {
  return {positionOf(sources, range.begin, unit), positionOf(sources, range.end, unit)};
}

SourcePos posOf(const SourceManager& sources, FileId file, Position position, Unit unit) {
  if (position.line >= sources.lineCount(file)) return sources.position(file, sources.text(file).size());
  const std::string_view line = sources.lineText(file, position.line + 1);
  const auto begin = static_cast<size_t>(line.data() - sources.text(file).data());
  return sources.position(file, begin + bytesOf(line, position.character, unit));
}

} // namespace rung::lsp
