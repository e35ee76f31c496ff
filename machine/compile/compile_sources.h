// From packed sources to a program file, in memory.
#pragma once
#include <string_view>

#include "machine/compile/outcome.h"

namespace rung::compile {

// Opens no file; the linker writes to standard output (see buildLlvmSharedObjectByOutput).
Outcome compileSources(std::string_view packed);

} // namespace rung::compile
