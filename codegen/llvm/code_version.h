// The version of all that makes code.
#pragma once
#include <string_view>

namespace rung::codegen {

// Changes whenever a source changes that decides what code a module becomes: code made by another version must not be
// taken from a cache. It ends in a zero byte.
std::string_view codeVersion();

} // namespace rung::codegen
