// LLVM back end: a module as LLVM IR, assembly, object file or shared object, for this computer or another target. No
// external compiler or linker is called: both run in the process. This header does not include LLVM.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ir/shape/layout.h"
#include "ir/support/result.h"

namespace rung::codegen {

enum class LlvmLevel : uint8_t {
  Fast, // no passes, fastest code generation: to try a change at once
  Opt,  // a few cheap passes and full code generation: for production
};

struct LlvmOptions {
  LlvmLevel level = LlvmLevel::Opt;
  bool debugInfo = true; // lines and names of the PLC source
  std::string target;    // one of llvmTargets(); empty: this computer
};

// The values of `target`.
std::vector<std::string_view> llvmTargets();

// `codeHash` goes into the program's tables. emitLlvmIr returns the text after the passes of the level.
Result<std::string> emitLlvmIr(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options);
Result<std::string> emitAssembly(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options);
Result<std::string> emitObject(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options);

// The bytes of a `.so` that exports rung_program_table and needs no library (32-bit ARM: libgcc_s.so.1, for division
// and for i64 to and from f64).
Result<std::string> buildLlvmSharedObject(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options);

// The same for a process that may not open files: the linker writes to its standard output, which must be a memory file
// that no other process uses. The linker only opens /proc/self/fd/N, N being a file that is open already, to read it.
Result<std::string> buildLlvmSharedObjectByOutput(const ir::Layout& layout, uint64_t codeHash,
                                                  const LlvmOptions& options);

} // namespace rung::codegen
