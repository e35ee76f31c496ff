// A number that many branches of a chunk load, and that nothing in between writes, is loaded once, above them: timers
// that run share the time that has passed.
#pragma once

namespace llvm {
class Function;
}

namespace rung::codegen {

// For the end of the passes over LLVM's IR, which have found what is loaded at all. The function is a chunk's, with the
// memory block as its first argument. True: it has changed.
bool shareLoads(llvm::Function& function);

} // namespace rung::codegen
