// On x86 a comparison can take the place of a negation: with bits in bytes, a and not b is b < a, whose flag is stored
// in one instruction, and of what is negated as a whole the flag of zero is stored.
#pragma once

namespace llvm {
class Function;
}

namespace rung::codegen {

// For the end of the passes over LLVM's IR: earlier ones would make the negations again. The function is a chunk's, for
// x86. True: it has changed.
bool negateInFlags(llvm::Function& function);

} // namespace rung::codegen
