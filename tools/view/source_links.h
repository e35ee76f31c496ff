// Links from a page to the lines of the sources.
#pragma once
#include <string>
#include <string_view>

#include "tools/view/html.h"

namespace rung::view {

// From the lines of a source to it as seen from the folder of the page.
inline constexpr std::string_view kSourceLink = "{file}#L{line}";

// `link` with {file}, the source as seen from the folder of `page`; {path}, the whole path of the source; {line}.
LinkTo sourceLinks(std::string_view page, std::string_view link);

} // namespace rung::view
