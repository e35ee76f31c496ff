// LLVM's back end as a library that a program loads when it first needs it: loading LLVM takes longer than most of what
// the compiler does without it. The programs have load.cpp, and the plug-in the real functions; both are of one build.
#pragma once
#include "codegen/jit/jit_code.h"
#include "codegen/llvm/llvm_emitter.h"
#include "codegen/llvm/sections.h"

namespace rung::codegen {

struct LlvmFunctions {
  decltype(&emitLlvmIr) irText;
  decltype(&emitAssembly) assembly;
  decltype(&buildLlvmSharedObject) sharedObject;
  decltype(&withSection) withSection;
  decltype(&sectionOf) sectionOf;
  decltype(&makeJitCode) jitCode;
};

// What the plug-in exports: its functions, which stay as they are.
using GetLlvmFunctions = const LlvmFunctions* (*)();
inline constexpr const char* kLlvmPlugin = "rung-llvm.so";
inline constexpr const char* kGetLlvmFunctions = "rung_llvm_functions";

} // namespace rung::codegen
