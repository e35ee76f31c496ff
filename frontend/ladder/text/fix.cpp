// Fixes that replace words in drawings (see fix.h).
#include "frontend/ladder/text/fix.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "frontend/ladder/text/drawing.h"

namespace rung::frontend::ladder {
namespace {

/// The rest of an element from `at` on, and the wire on its right.
struct Rest {
  std::string_view closing; ///< text up to and including the closing bracket
  size_t wire = 0;
  bool last = false; ///< nothing follows on the line
};

std::optional<Rest> restOf(std::string_view line, size_t at) {
  const size_t close = line.find_first_of("])}", at);
  if (close == std::string_view::npos) return std::nullopt;
  Rest rest{.closing = line.substr(at, close + 1 - at)};
  if (rest.closing.find('"') != std::string_view::npos) return std::nullopt; // the bracket may be in a text
  const size_t end = std::min(line.find_first_not_of('-', close + 1), line.size());
  rest.wire = end - close - 1;
  const size_t further = line.find_first_not_of(" \r", end);
  rest.last = rest.wire == 0 && (further == std::string_view::npos || line[further] == ';');
  return rest;
}

bool isDrawing(std::string_view line) {
  const size_t first = line.find_first_not_of(' ');
  return first != std::string_view::npos && beginsDrawing(line[first]);
}

/// A source range and its replacement text.
struct Change {
  SourceRange range;
  std::string text;
};

/// The change that replaces `range` by the word; in a drawing the wire on its right absorbs the difference in length.
/// nullopt if the word does not fit.
std::optional<Change> changeOf(const SourceManager& sources, SourceRange range, std::string_view word) {
  const std::string_view line = sources.lineText(range.begin);
  const std::string_view old = sources.text(range);
  if (old.size() == word.size() || !isDrawing(line)) return Change{range, std::string(word)};
  const SourceManager::LineStart start = sources.lineStart(range.begin);
  const size_t end = sources.offsetOf(range.end) - start.offset;
  const std::optional<Rest> rest = restOf(line, end);
  if (rest && rest->last) return Change{range, std::string(word)};
  // At least one '-' of the wire must remain.
  if (!rest || rest->wire == 0 || rest->wire + old.size() <= word.size()) return std::nullopt;
  const size_t wire = rest->wire + old.size() - word.size();
  const SourceRange whole{range.begin,
                          sources.position(start.file, start.offset + end + rest->closing.size() + rest->wire)};
  return Change{whole, std::string(word) + std::string(rest->closing) + std::string(wire, '-')};
}

/// Adds a fix for all places or for none: a name corrected at only some of its places would become two names.
void meantAt(DiagBuilder& report, const SourceManager& sources, std::span<const SourceRange> places,
             std::string_view word) {
  std::vector<Change> changes;
  for (const SourceRange place : places) {
    std::optional<Change> change = changeOf(sources, place, word);
    const bool meetsLast = change && !changes.empty() && change->range.begin < changes.back().range.end;
    if (!change || meetsLast) return static_cast<void>(report.meant({}, word));
    changes.push_back(std::move(*change));
  }
  const bool isSaid = changes[0].range == places[0];
  report.meant(isSaid ? places[0] : SourceRange{}, word);
  for (const Change& change : std::span(changes).subspan(isSaid ? 1 : 0)) report.fix(change.range, change.text);
}

} // namespace

void meant(DiagBuilder& report, const SourceManager& sources, SourceRange range, std::string_view word) {
  meantAt(report, sources, {&range, 1}, word);
}

void fix(DiagBuilder& report, const SourceManager& sources, SourceRange range, std::string_view word) {
  if (const std::optional<Change> change = changeOf(sources, range, word)) report.fix(change->range, change->text);
}

void suggest(DiagBuilder& report, const SourceManager& sources, std::span<const SourceRange> places,
             const text::Likely& likely) {
  if (likely.certain)
    meantAt(report, sources, places, likely.word);
  else
    report.meant({}, likely.word);
}

} // namespace rung::frontend::ladder
