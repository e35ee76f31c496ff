// The IR of a program, embedded in its shared object so that its code can be recompiled without the sources.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "compiler/compile.h"
#include "ir/support/result.h"
#include "rung/program.h"

namespace rung::compiler {

// The shared object with the IR in a section that is not loaded. `compiled` must have its module as built (keepBuilt).
Result<std::string> withIr(std::string_view object, const Compiled& compiled);

// The identity of a program.
struct Hashes {
  uint64_t code = 0;
  uint64_t layout = 0;
  bool operator==(const Hashes&) const = default;
};
inline Hashes hashesOf(const rung_program& program) { return {program.code_hash, program.layout_hash}; }

// What the object's program was compiled from, without sources and diagnostics. Fails if the object has no IR, or if
// this compiler makes a program other than `program` of it. The object may be any bytes.
Result<Compiled> irOf(std::string_view object, const Hashes& program);

} // namespace rung::compiler
