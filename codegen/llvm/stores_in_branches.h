// What a branch gives, often a constant, and what then is only stored, is stored by the branch itself: no register has
// to be filled with it.
#pragma once

namespace llvm {
class Function;
}

namespace rung::codegen {

// For the end of the passes over LLVM's IR: earlier ones would put the stores together again. The function is a
// chunk's, with the memory block as its first argument. True: it has changed.
bool storeInBranches(llvm::Function& function);

} // namespace rung::codegen
