// What the build makes for the LLVM back end.
#pragma once
#include <string_view>

namespace rung::codegen {

// LLVM bitcode of sem_bitcode.cpp.
std::string_view semBitcode();

} // namespace rung::codegen
