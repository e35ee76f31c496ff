// What is written at a place.
#include <fmt/format.h>

#include "compiler/reference.h"
#include "tools/lsp/features.h"

namespace rung::lsp {

json hover(const Place& place) {
  const auto text = place.program.text();
  if (!text) return nullptr;
  const SourceManager& sources = place.program.sources();
  const SourceManager::LineStart start = sources.lineStart(place.at);
  const std::string_view line = sources.lineText(place.file, start.line);
  const size_t column = sources.offsetOf(place.at) - start.offset;
  if (column >= line.size() || column < source::markLength(line)) return nullptr;
  const source::Explanation found = source::explain(*text, place.at);
  if (found.empty()) return nullptr;
  std::string value = compiler::withoutManualLines(found.reference);
  if (!found.program.empty()) value += fmt::format("{}```text\n{}```\n", value.empty() ? "" : "\n", found.program);
  return {{"contents", {{"kind", "markdown"}, {"value", std::move(value)}}}};
}

} // namespace rung::lsp
