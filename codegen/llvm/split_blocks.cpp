// See split_blocks.h.
#include "codegen/llvm/split_blocks.h"

#include <ranges>
#include <vector>

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

// Where the block is to be cut. Room on the stack comes first, and stays in the first block. Addresses do not
// count: they are part of the instructions that use them, and each block has its own.
std::vector<llvm::Instruction*> cutsOf(llvm::BasicBlock& block) {
  std::vector<llvm::Instruction*> cuts;
  uint32_t count = 0;
  for (llvm::Instruction& instruction : block) {
    if (addressOf(instruction) != nullptr) continue;
    const bool mayBegin = !llvm::isa<llvm::PHINode>(instruction) && !llvm::isa<llvm::AllocaInst>(instruction) &&
                          !instruction.isTerminator();
    if (mayBegin && count >= kMostInstructions) {
      cuts.push_back(&instruction);
      count = 0;
    }
    ++count;
  }
  return cuts;
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
  std::vector<llvm::Instruction*> cuts;
  for (llvm::BasicBlock& block : function) {
    const std::vector<llvm::Instruction*> ofBlock = cutsOf(block);
    cuts.insert(cuts.end(), ofBlock.begin(), ofBlock.end());
  }
  std::vector<llvm::BasicBlock*> made;
  for (llvm::Instruction* cut : std::ranges::reverse_view(cuts)) // the last first: what follows a cut is moved
    made.push_back(cut->getParent()->splitBasicBlock(cut));
  for (llvm::BasicBlock* block : made) takeAddresses(*block);
  return !made.empty();
}

} // namespace rung::codegen
