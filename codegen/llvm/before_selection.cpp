// See before_selection.h.
#include "codegen/llvm/before_selection.h"

#include <llvm/IR/Module.h>
#include <llvm/TargetParser/Triple.h>

#include "codegen/llvm/negations_in_flags.h"
#include "codegen/llvm/split_blocks.h"

namespace rung::codegen {
namespace {

class BeforeSelection final : public llvm::FunctionPass {
public:
  BeforeSelection() : FunctionPass(kId) {}

  bool doInitialization(llvm::Module& module) override {
    isX86_ = llvm::Triple(module.getTargetTriple()).isX86();
    return false;
  }

  bool runOnFunction(llvm::Function& function) override {
    const bool changed = isX86_ && function.hasFnAttribute(kChunkAttribute) && negateInFlags(function);
    return splitBlocks(function) || changed; // the last, for it gives blocks that it cuts their addresses
  }

private:
  static char kId; // LLVM knows a pass by its address
  bool isX86_ = false;
};

char BeforeSelection::kId = 0;

} // namespace

std::unique_ptr<llvm::FunctionPass> makeBeforeSelection() { return std::make_unique<BeforeSelection>(); }

} // namespace rung::codegen
