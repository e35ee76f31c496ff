// `allow(CODE)` or `allow(CODE, CODE)` in the comment of a declaration: suppresses these warnings. Only the compiler
// reads it.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace rung {

bool allows(std::string_view comment, std::string_view code);
// The codes in all allowances of the comment, known or not.
std::vector<std::string_view> allowedCodes(std::string_view comment);
// The comment without its allowances, for display.
std::string withoutAllowances(std::string_view comment);

} // namespace rung
