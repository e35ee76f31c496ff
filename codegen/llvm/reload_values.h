// A value that was loaded from the memory block or stored to it, and is used again far below, would be kept in a
// register meanwhile, or spilled, as registers are few: stored on the stack and loaded from there. Loaded from its
// place instead it costs the second half of that, mostly within the instruction that uses it.
#pragma once

namespace llvm {
class Function;
}

namespace rung::codegen {

// For the end of the passes over LLVM's IR: earlier ones would find that the loads are the same. The function is a
// chunk's, with the memory block as its first argument. True: it has changed.
bool reloadValues(llvm::Function& function);

} // namespace rung::codegen
