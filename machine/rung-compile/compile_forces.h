// Compiles packed forces to a program file in memory: the program with chunks that leave the forced bits as they are.
#pragma once
#include <string_view>

#include "machine/rung-compile/outcome.h"

namespace rung::rung_compile {

// Opens no file; the linker writes to standard output (see buildLlvmSharedObjectByOutput). The resulting file contains
// no IR.
Outcome compileForces(std::string_view packed);

} // namespace rung::rung_compile
