// What every page begins and ends with. Internal to the pages.
#pragma once
#include <string>
#include <string_view>

#include "tools/view/html.h"

namespace rung::view {

struct PageHead {
  std::string_view title;
  std::string_view control;
  size_t rungs = 0;
  std::string_view style; // rules of this page, after those of all
};

// The heading; on paper every page has it, with its number.
void beginPage(std::string& out, const PageHead& head, const PageOptions& options);
void endPage(std::string& out);

// As a value of `content`.
std::string cssText(std::string_view text);
// "main.lad:12", with a link where there is one; nothing for a place without a line.
void appendPlace(std::string& out, const SourceFile& file, uint32_t line, const PageOptions& options);

} // namespace rung::view
