// The lines of a rung that was parsed before, as tokens again.
#include "frontend/ladder/text/drawing.h"
#include "ir/support/check.h"

namespace rung::frontend::ladder {

Drawing readDrawing(const SourceManager& sources, FileId file, const Rung& rung, FindBox findBox) {
  Drawing drawing;
  Diagnostics discarded;
  const char* const begin = sources.text(file).data();
  for (uint32_t number = rung.firstLine + 1; number <= rung.lastLine; ++number) {
    const std::string_view text = sources.lineText(file, number);
    const size_t first = text.find_first_not_of(' ');
    if (first == std::string_view::npos || text[first] == ';') continue;
    const auto offset = static_cast<size_t>(text.data() - begin);
    scanDrawingLine({number, text, sources.position(file, offset)}, drawing, discarded);
  }
  dropRightRail(drawing);
  groupPins(drawing, findBox, discarded);
  RUNG_CHECK(!drawing.bad, "the rung was parsed without errors");
  return drawing;
}

} // namespace rung::frontend::ladder
