// The LLVM back end as a library that a program loads on first use: loading LLVM takes longer than most other work of
// the compiler. Programs contain load.cpp, the plug-in the real functions; both must come from the same build.
#pragma once
#include "codegen/jit/jit_code.h"
#include "codegen/llvm/llvm_emitter.h"
#include "codegen/llvm/sections.h"

namespace rung::codegen {

struct LlvmFunctions {
  decltype(&codegen::emitLlvmIr) irText;
  decltype(&codegen::emitAssembly) assembly;
  decltype(&codegen::buildLlvmSharedObject) sharedObject;
  decltype(&codegen::withSection) withSection;
  decltype(&codegen::sectionOf) sectionOf;
  decltype(&codegen::makeJitCode) jitCode;
};

// The plug-in's export. It returns the table of its functions, which stays valid.
using GetLlvmFunctions = const LlvmFunctions* (*)();
inline constexpr const char* kLlvmPlugin = "rung-llvm.so";
inline constexpr const char* kGetLlvmFunctions = "rung_llvm_functions";

} // namespace rung::codegen
