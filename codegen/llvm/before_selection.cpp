// See before_selection.h.
#include "codegen/llvm/before_selection.h"

#include "codegen/llvm/reload_values.h"
#include "codegen/llvm/split_blocks.h"
#include "codegen/llvm/stores_in_branches.h"

namespace rung::codegen {
namespace {

class BeforeSelection final : public llvm::FunctionPass {
public:
  BeforeSelection() : FunctionPass(kId) {}

  bool runOnFunction(llvm::Function& function) override {
    bool changed = false;
    if (function.hasFnAttribute(kChunkAttribute)) {
      changed = storeInBranches(function) || changed;
      changed = reloadValues(function) || changed;
    }
    return splitBlocks(function) || changed; // the last, for it gives blocks that it cuts their addresses
  }

private:
  static char kId; // LLVM knows a pass by its address
};

char BeforeSelection::kId = 0;

} // namespace

std::unique_ptr<llvm::FunctionPass> makeBeforeSelection() { return std::make_unique<BeforeSelection>(); }

} // namespace rung::codegen
