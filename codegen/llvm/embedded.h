// What the build makes for the LLVM back end.
#pragma once
#include <string_view>

namespace rung::codegen {

// LLVM bitcode of sem_bitcode.cpp.
std::string_view semBitcode();

// The version of all that makes code. It changes whenever a source changes that decides what code a module becomes:
// code made by another version must not be taken from a cache. It ends in a zero byte.
std::string_view codeVersion();

} // namespace rung::codegen
