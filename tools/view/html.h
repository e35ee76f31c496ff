// A program as one self-contained HTML file, for the screen (light or dark, of any width) and for paper.
#pragma once
#include <functional>
#include <string>

#include "tools/view/program.h"

namespace rung::view {

// The link of a source line; nothing if it has none.
using LinkTo = std::function<std::string(const SourceFile& file, uint32_t line)>;

struct PageOptions {
  std::string date; // as printed on the page
  std::string revision;
  LinkTo linkTo; // may be empty
};

// The page has drawings, names with their uses, and a search.
std::string renderHtml(const Program& program, const PageOptions& options = {});

} // namespace rung::view
