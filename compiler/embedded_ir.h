// The IR of a program as its shared object carries it, so that its code can be made again without the sources.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "compiler/compile.h"
#include "ir/support/result.h"
#include "rung/program.h"

namespace rung::compiler {

// The shared object with the IR in a section that is not loaded. `compiled` has been kept as it was built.
Result<std::string> withIr(std::string_view object, const Compiled& compiled);

// Which program it is.
struct Hashes {
  uint64_t code = 0;
  uint64_t layout = 0;
  bool operator==(const Hashes&) const = default;
};
inline Hashes hashesOf(const rung_program& program) { return {program.code_hash, program.layout_hash}; }

// What the object's program was compiled from, but for sources and diagnostics. Fails where the object carries no IR,
// or where this compiler makes another program of it than `program`. The object may be any bytes.
Result<Compiled> irOf(std::string_view object, const Hashes& program);

} // namespace rung::compiler
