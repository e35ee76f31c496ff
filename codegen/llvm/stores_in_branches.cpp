// See stores_in_branches.h.
#include "codegen/llvm/stores_in_branches.h"

#include <llvm/ADT/STLExtras.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/Module.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>

#include "codegen/llvm/memory_place.h"

namespace rung::codegen {
namespace {

constexpr unsigned kMostBranches = 4;
constexpr unsigned kMostAbove = 64; // instructions that a store may pass

class BranchStores {
public:
  explicit BranchStores(const llvm::Function& function)
      : memory_(*function.getArg(0)), data_(function.getParent()->getDataLayout()) {}

  bool run(llvm::BasicBlock& block) {
    if (!isJoin(block)) return false;
    bool changed = false;
    for (llvm::PHINode& joined : llvm::make_early_inc_range(block.phis())) {
      if (!isOnlyStored(joined)) continue;
      giveBranches(block);
      store(joined);
      changed = true;
    }
    return changed;
  }

private:
  // From each block before it there is one way to it.
  static bool isJoin(const llvm::BasicBlock& block) {
    return !block.hasNPredecessorsOrMore(kMostBranches + 1) &&
           llvm::all_of(llvm::predecessors(&block), [](const llvm::BasicBlock* before) {
             const auto* jump = llvm::dyn_cast<llvm::BranchInst>(before->getTerminator());
             return jump != nullptr && (jump->isUnconditional() || jump->getSuccessor(0) != jump->getSuccessor(1));
           });
  }

  // Each way to the block gets a block of its own.
  static void giveBranches(llvm::BasicBlock& block) {
    const llvm::SmallVector<llvm::BasicBlock*, kMostBranches> all(llvm::predecessors(&block));
    for (llvm::BasicBlock* before : all)
      if (before->getSingleSuccessor() == nullptr) llvm::SplitEdge(before, &block);
  }

  bool isOnlyStored(llvm::PHINode& joined) const {
    const bool hasConstant = llvm::any_of(joined.incoming_values(),
                                          [](const llvm::Use& value) { return llvm::isa<llvm::ConstantInt>(value); });
    return hasConstant && !joined.use_empty() && llvm::all_of(joined.users(), [&](llvm::User* user) {
             auto* store = llvm::dyn_cast<llvm::StoreInst>(user);
             return store != nullptr && store->isSimple() && store->getValueOperand() == &joined &&
                    store->getParent() == joined.getParent() && mayBeFirst(*store);
           });
  }

  // Nothing above it in its block accesses its place.
  bool mayBeFirst(llvm::StoreInst& store) const {
    const std::optional<int64_t> place = offsetIn(memory_, *store.getPointerOperand(), data_);
    if (!place) return false;
    const int64_t end = *place + bytesOf(*store.getValueOperand()->getType(), data_);
    unsigned count = 0;
    for (llvm::Instruction& above : *store.getParent()) {
      if (&above == &store) return true;
      if (++count > kMostAbove) return false;
      if (!above.mayReadOrWriteMemory()) continue;
      const llvm::Value* address = llvm::getLoadStorePointerOperand(&above);
      const std::optional<int64_t> other = address != nullptr ? offsetIn(memory_, *address, data_) : std::nullopt;
      if (!other) return false;
      const int64_t otherEnd = *other + bytesOf(*llvm::getLoadStoreType(&above), data_);
      if (*other < end && *place < otherEnd) return false;
    }
    return false;
  }

  static void store(llvm::PHINode& joined) {
    while (!joined.use_empty()) {
      auto& after = *llvm::cast<llvm::StoreInst>(*joined.user_begin());
      for (unsigned i = 0; i < joined.getNumIncomingValues(); ++i) {
        llvm::Instruction* jump = joined.getIncomingBlock(i)->getTerminator();
        llvm::Instruction* store = after.clone();
        store->setOperand(0, joined.getIncomingValue(i));
        store->setOperand(1, &addressBefore(*after.getPointerOperand(), *jump));
        store->insertBefore(jump->getIterator());
      }
      after.eraseFromParent();
    }
    joined.eraseFromParent();
  }

  const llvm::Argument& memory_;
  const llvm::DataLayout& data_;
};

} // namespace

bool storeInBranches(llvm::Function& function) {
  BranchStores stores(function);
  bool changed = false;
  for (llvm::BasicBlock& block : function)
    if (stores.run(block)) changed = true;
  return changed;
}

} // namespace rung::codegen
