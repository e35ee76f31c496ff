// Puts other words into ladder text: a drawing in which one has another length gets new columns.
#pragma once
#include <string>
#include <vector>

#include "frontend/ladder/text/ladder_file.h"

namespace rung::frontend::ladder {

/// The characters of the range become the text.
struct Change {
  SourceRange range;
  std::string text;
};

/// The changes of the file that do what these do: those of words in a drawing are replaced by changes of its lines.
/// `words`: of operands, names and declarations, in the order of the text. A rung with errors, or one that cannot be
/// laid out, keeps its columns.
std::vector<Change> withDrawings(const SourceManager& sources, FileId file, FindBox findBox, std::vector<Change> words);

} // namespace rung::frontend::ladder
