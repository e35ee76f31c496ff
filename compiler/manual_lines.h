// References to lines of a manual and to proposals, which the tables have beside their texts. A user at a terminal does
// not have those lines.
#pragma once
#include <string>
#include <string_view>

namespace rung::compiler {

// The Markdown without "l.1271", "man. l.540" and "P17" in brackets and after "Manual:"; brackets with nothing else go.
// Fenced blocks stay as they are.
std::string withoutManualLines(std::string_view markdown);

} // namespace rung::compiler
