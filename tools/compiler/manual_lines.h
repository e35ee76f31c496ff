// References to lines of a manual and to proposals, which the tables have beside what they say: nobody who asks at
// a terminal has those lines.
#pragma once
#include <string>
#include <string_view>

namespace rung::compiler {

// The Markdown without "l.1271", "man. l.540" and "P17": in brackets, of which nothing stays where they are all that is
// in them, and after "Manual:". Fenced blocks stay as they are.
std::string withoutManualLines(std::string_view markdown);

} // namespace rung::compiler
