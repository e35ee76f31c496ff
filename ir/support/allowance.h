// `allow(CODE)` or `allow(CODE, CODE)` in the comment of a declaration: warnings that are meant. It speaks to the compiler
// alone.
#pragma once
#include <string>
#include <string_view>

namespace rung {

bool allows(std::string_view comment, std::string_view code);
// The comment as a reader is to see it.
std::string withoutAllowances(std::string_view comment);

} // namespace rung
