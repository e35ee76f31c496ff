// `allow(CODE)` or `allow(CODE, CODE)` in the comment of a declaration: warnings that are meant. It speaks to the
// compiler alone.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace rung {

bool allows(std::string_view comment, std::string_view code);
// The codes of all allowances in it, known ones and others.
std::vector<std::string_view> allowedCodes(std::string_view comment);
// The comment as a reader is to see it.
std::string withoutAllowances(std::string_view comment);

} // namespace rung
