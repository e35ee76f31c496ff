// See split_blocks.h.
#include "codegen/llvm/split_blocks.h"

#include <llvm/ADT/DenseMap.h>
#include <llvm/IR/BasicBlock.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/Instructions.h>

namespace rung::codegen {
namespace {

constexpr uint32_t kMostInstructions = 512;

// Of a place in a memory block that an argument points to.
llvm::GetElementPtrInst* addressOf(llvm::Value& value) {
  auto* address = llvm::dyn_cast<llvm::GetElementPtrInst>(&value);
  const bool isPlace =
      address != nullptr && address->hasAllConstantIndices() && llvm::isa<llvm::Argument>(address->getPointerOperand());
  return isPlace ? address : nullptr;
}

// Where the block is to be cut; its end: nowhere. Room on the stack comes first, and stays in the first block.
// Addresses do not count: they are part of the instructions that use them, and each block has its own.
llvm::BasicBlock::iterator cutOf(llvm::BasicBlock& block) {
  uint32_t count = 0;
  for (auto i = block.begin(); i != block.end(); ++i) {
    if (addressOf(*i) != nullptr) continue;
    const bool mayBegin = !llvm::isa<llvm::PHINode>(*i) && !llvm::isa<llvm::AllocaInst>(*i) && !i->isTerminator();
    if (mayBegin && count >= kMostInstructions) return i;
    ++count;
  }
  return block.end();
}

// The selector folds addresses of the memory block into the instructions of their own block, and keeps those of other
// blocks in registers.
void takeAddresses(llvm::BasicBlock& block) {
  llvm::DenseMap<llvm::Instruction*, llvm::Instruction*> own;
  for (llvm::Instruction& instruction : block) {
    if (llvm::isa<llvm::PHINode>(instruction)) continue;
    for (llvm::Use& operand : instruction.operands()) {
      llvm::GetElementPtrInst* address = addressOf(*operand);
      if (address == nullptr || address->getParent() == &block) continue;
      llvm::Instruction*& here = own[address];
      if (here == nullptr) {
        here = address->clone();
        here->insertBefore(block.getFirstInsertionPt());
      }
      operand.set(here);
    }
  }
}

} // namespace

bool splitBlocks(llvm::Function& function) {
  bool changed = false;
  for (auto block = function.begin(); block != function.end(); ++block) { // those that are made follow
    const auto cut = cutOf(*block);
    if (cut == block->end()) continue;
    takeAddresses(*block->splitBasicBlock(cut));
    changed = true;
  }
  return changed;
}

} // namespace rung::codegen
