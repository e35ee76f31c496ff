// A small program built by hand, for the tests of the LLVM back end and the JIT.
#pragma once
#include "ir/core/module.h"

namespace rung::codegen {

// MAIN, in sample.lad: rung 0 (line 3) Y0.0 := X0.0 and not X0.1; rung 1 (line 6) calls COUNT while Y0.0 is on. COUNT
// (line 9) adds 1 to a word and stops with fault 0 when it reaches 3.
ir::Module sampleModule();

} // namespace rung::codegen
