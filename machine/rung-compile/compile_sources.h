// Compiles packed sources to a program file in memory.
#pragma once
#include <string_view>

#include "machine/rung-compile/outcome.h"

namespace rung::rung_compile {

// Opens no file; the linker writes to standard output (see buildLlvmSharedObjectByOutput).
Outcome compileSources(std::string_view packed);

} // namespace rung::rung_compile
