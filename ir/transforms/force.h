// Cells that a person holds at a value while the program runs.
#pragma once
#include <cstdint>
#include <span>

#include "ir/core/module.h"

namespace rung::ir {

// Not in the pipeline, and before it: for a module as its front end built it, because a value that is stored may be
// used again in the place of a load. `forced`: in the order of space and byte, each once. No operation of the module
// leaves another value in these bits for a later one.
void forceBits(Module& module, std::span<const rung_forced_byte> forced);

} // namespace rung::ir
