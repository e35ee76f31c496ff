// The last pass over LLVM's IR, immediately before instruction selection: changes that any earlier pass would undo. It
// splits long blocks and, on x86, replaces negations by comparisons.
#pragma once
#include <memory>

#include <llvm/Pass.h>

namespace rung::codegen {

// Marks a function as a chunk: its first argument is the memory block.
inline constexpr char kChunkAttribute[] = "rung-chunk";

std::unique_ptr<llvm::FunctionPass> makeBeforeSelection();

} // namespace rung::codegen
