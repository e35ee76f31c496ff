// The IR of a program as its shared object carries it, so that its code can be made again without the sources.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "ir/support/result.h"
#include "rung/program.h"
#include "tools/compiler/compile.h"

namespace rung::compiler {

// The shared object with the IR in a section that is not loaded. `compiled` has been kept as it was built.
Result<std::string> withIr(std::string_view object, const Compiled& compiled);

// What the object `program` was compiled from, but for sources and diagnostics. Fails where the object carries no IR,
// or where this compiler makes another program of it.
Result<Compiled> irOf(std::string_view object, const rung_program& program);

} // namespace rung::compiler
