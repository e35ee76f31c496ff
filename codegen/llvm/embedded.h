// Data that the build embeds for the LLVM back end.
#pragma once
#include <string_view>

namespace rung::codegen {

// LLVM bitcode of sem_bitcode.cpp.
std::string_view semBitcode();

// The version of everything that determines the code of a module. It changes with every source that does: code made by
// another version must not be taken from a cache. It ends with a zero byte.
std::string_view codeVersion();

} // namespace rung::codegen
