// The last pass over LLVM's IR, right before instructions are selected: what every earlier one would undo. It
// cuts long blocks and, on x86, puts comparisons in the place of negations.
#pragma once
#include <memory>

#include <llvm/Pass.h>

namespace rung::codegen {

// Of a function that is a chunk: its first argument is the memory block.
inline constexpr char kChunkAttribute[] = "rung-chunk";

std::unique_ptr<llvm::FunctionPass> makeBeforeSelection();

} // namespace rung::codegen
