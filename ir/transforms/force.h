// Forces cells to values while the program runs.
#pragma once
#include <cstdint>
#include <span>

#include "ir/core/module.h"

namespace rung::ir {

// Not in the pipeline, but before it: for a module as its front end built it, because passes may reuse a stored value
// in place of a load. `forced`: ordered by space and byte, each once. Afterwards no operation of the module leaves
// another value in these bits for a later one.
void forceBits(Module& module, std::span<const rung_forced_byte> forced);

} // namespace rung::ir
