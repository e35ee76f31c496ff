// Long blocks are cut before instructions are selected: the selector and what follows it look through a whole block for
// one instruction, so that time would grow with the square of a rung's length.
#pragma once

namespace llvm {
class Function;
}

namespace rung::codegen {

// For the end of the passes over LLVM's IR: earlier ones would put the blocks together again. True: it has changed.
bool splitBlocks(llvm::Function& function);

} // namespace rung::codegen
