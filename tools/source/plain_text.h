// Entries of the reference, which are Markdown, for a terminal.
#pragma once
#include <string>
#include <string_view>

namespace rung::source {

// Tables aligned, long cells on several lines, no heading marks.
std::string plainText(std::string_view markdown);

} // namespace rung::source
