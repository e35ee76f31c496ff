// A program as one HTML file that needs nothing else. For the screen, light or dark and of any width, and for paper.
#pragma once
#include <functional>
#include <string>

#include "tools/view/drawn_program.h"
#include "tools/view/overlay.h"
#include "tools/view/program.h"

namespace rung::view {

// Where a line of a source leads; nothing where it leads nowhere.
using LinkTo = std::function<std::string(const SourceFile& file, uint32_t line)>;

struct PageOptions {
  std::string date; // as it is to be printed
  std::string revision;
  LinkTo linkTo; // may be empty
};

// Drawings, names with their uses, a search.
std::string renderHtml(const Program& program, const PageOptions& options = {});

// A page in the look of renderHtml: the source by rung, with what was not seen of a rung's elements beside it. Nothing
// is said of runs where the overlay is empty.
std::string renderTable(const Listing& listing, const Overlay& overlay, const PageOptions& options = {});

} // namespace rung::view
