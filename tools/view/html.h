// A program as one HTML file that needs nothing else: drawings, names with their uses, a search. For the screen, light
// or dark and of any width, and for paper.
#pragma once
#include <functional>
#include <string>

#include "tools/view/program.h"

namespace rung::view {

// Where a line of a source leads; nothing where it leads nowhere.
using LinkTo = std::function<std::string(const SourceFile& file, uint32_t line)>;

struct PageOptions {
  std::string date; // as it is to be printed
  std::string revision;
  LinkTo linkTo; // may be empty
};

std::string renderHtml(const Program& program, const PageOptions& options = {});

} // namespace rung::view
