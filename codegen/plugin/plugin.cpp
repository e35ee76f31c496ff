// The part in the plug-in (see functions.h).
#include "codegen/plugin/functions.h"

#include "codegen/llvm/embedded.h"
#include "ir/support/result.h"

namespace rung::codegen {
namespace {

// A ThrowingChecks of the program has no effect in the plug-in: here internal errors of the compiler or LLVM become
// failures.
template <auto function>
struct Contained;
template <class Answer, class... Arguments, Answer (*function)(Arguments...)>
struct Contained<function> {
  static Answer call(Arguments... arguments) {
    return contained([&] { return function(arguments...); });
  }
};

constexpr LlvmFunctions kFunctions{
    .irText = &Contained<&emitLlvmIr>::call,
    .assembly = &Contained<&emitAssembly>::call,
    .sharedObject = &Contained<&buildLlvmSharedObject>::call,
    .withSection = &Contained<&withSection>::call,
    .sectionOf = &Contained<&sectionOf>::call,
    .jitCode = &Contained<&makeJitCode>::call,
};

} // namespace
} // namespace rung::codegen

extern "C" const char* rung_plugin_build() { return rung::codegen::codeVersion().data(); }
extern "C" const rung::codegen::LlvmFunctions* rung_llvm_functions() { return &rung::codegen::kFunctions; }
