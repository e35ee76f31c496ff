// What every page begins and ends with. Internal to the pages.
#pragma once
#include <string>
#include <string_view>

namespace rung::view {

// To the heading with the title. `style`: rules of this page, after those of all.
void beginPage(std::string& out, std::string_view title, std::string_view style);
void endPage(std::string& out);

} // namespace rung::view
