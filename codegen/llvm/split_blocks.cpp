// See split_blocks.h.
#include "codegen/llvm/split_blocks.h"

#include <llvm/IR/BasicBlock.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/Instructions.h>

namespace rung::codegen {
namespace {

constexpr uint32_t kMostInstructions = 512;

// Where the block is to be cut; its end: nowhere. Room on the stack comes first, and stays in the first block.
llvm::BasicBlock::iterator cutOf(llvm::BasicBlock& block) {
  uint32_t count = 0;
  for (auto i = block.begin(); i != block.end(); ++i, ++count) {
    if (llvm::isa<llvm::PHINode>(*i) || llvm::isa<llvm::AllocaInst>(*i) || i->isTerminator()) continue;
    if (count >= kMostInstructions) return i;
  }
  return block.end();
}

class SplitBlocks final : public llvm::FunctionPass {
public:
  SplitBlocks() : FunctionPass(kId) {}

  bool runOnFunction(llvm::Function& function) override {
    bool changed = false;
    for (auto block = function.begin(); block != function.end(); ++block) { // those that are made follow
      const auto cut = cutOf(*block);
      if (cut == block->end()) continue;
      block->splitBasicBlock(cut);
      changed = true;
    }
    return changed;
  }

private:
  static char kId; // LLVM knows a pass by its address
};

char SplitBlocks::kId = 0;

} // namespace

std::unique_ptr<llvm::FunctionPass> makeSplitBlocks() { return std::make_unique<SplitBlocks>(); }

} // namespace rung::codegen
