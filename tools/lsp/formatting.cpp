// The text in the style of its language.
#include "tools/lsp/features.h"

namespace rung::lsp {

// One change of the whole text: editors find out themselves what differs. None for a text with syntax errors.
json formatting(Program& program, FileId file, Unit unit) {
  if (program.dialect() == nullptr) return json::array();
  SourceManager own;
  const std::string_view text = program.sources().text(file);
  const FileId copy = own.addBuffer(std::string(program.sources().name(file)), std::string(text));
  Diagnostics unseen; // those of the check are shown
  const std::optional<std::string> formatted = program.dialect()->format(own, copy, unseen);
  if (!formatted || *formatted == text) return json::array();
  const Range whole{{}, positionOf(own, own.position(copy, text.size()), unit)};
  return json::array({{{"range", toJson(whole)}, {"newText", *formatted}}});
}

} // namespace rung::lsp
