// LLVM back end: a module as LLVM IR, assembly, object file or shared object, for this machine or another. No compiler
// and no linker is called: both work inside the process. This header is free of LLVM.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ir/shape/layout.h"
#include "ir/support/result.h"

namespace rung::codegen {

enum class LlvmLevel : uint8_t {
  Fast, // no passes, quickest code generation: to try a change at once
  Opt,  // a few cheap passes and good code generation: to run
};

struct LlvmOptions {
  LlvmLevel level = LlvmLevel::Opt;
  bool debugInfo = true; // lines and names of the PLC source
  std::string target;    // one of llvmTargets(); empty: this machine
};

// The triples that `target` may name.
std::vector<std::string_view> llvmTargets();

// `codeHash` goes into the program's tables. The text of emitLlvmIr is what the passes of the level leave.
Result<std::string> emitLlvmIr(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options);
Result<std::string> emitAssembly(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options);
Result<std::string> emitObject(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options);

// The bytes of a `.so` that exports rung_program_table and needs no library (32-bit ARM: libgcc_s.so.1, for division
// and for i64 to and from f64).
Result<std::string> buildLlvmSharedObject(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options);

// The same for a process that cannot open files: the linker writes to its standard output, which is a memory file and
// used by no other process. The linker opens nothing but /proc/self/fd/N, N being a file that is open already, to read
// it.
Result<std::string> buildLlvmSharedObjectByOutput(const ir::Layout& layout, uint64_t codeHash,
                                                  const LlvmOptions& options);

} // namespace rung::codegen
