// Entries of the reference as a terminal shows them: tables aligned, long cells over several lines, no marks of
// headings.
#pragma once
#include <string>
#include <string_view>

namespace rung::rungc {

std::string plainText(std::string_view markdown);

} // namespace rung::rungc
