// How many machine instructions a chunk takes at most: the longest path through its code as the JIT makes it, with the
// constant bounds of its loops. Free of LLVM.
#pragma once
#include <vector>

#include "codegen/jit/code_paths.h"
#include "codegen/llvm/llvm_emitter.h"

namespace rung::codegen {

// By chunk. What the host's functions do is not in it. `options`: for this machine, `target` is empty.
Result<std::vector<CodeLength>> boundInstructions(const ir::Layout& layout, uint64_t codeHash,
                                                  const LlvmOptions& options);

} // namespace rung::codegen
