// The IR of a program, embedded in its shared object so that its code can be recompiled without the sources.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "compiler/compile.h"
#include "ir/support/result.h"
#include "rung/program.h"

namespace rung::compiler {

// The IR with its marks as text, from which the program can be compiled without its sources. `compiled` must have its
// module as built (keepBuilt).
std::string irText(const Compiled& compiled);
// What such a text was compiled to, without sources and diagnostics. It may be any bytes.
Result<Compiled> compiledOf(std::string_view text);
// The same of a file of a recording (docs/recording.md): a shared object that contains the text, or the text itself.
// Fails if this compiler makes a program with another hash of it.
Result<Compiled> programOf(std::string_view file, uint64_t codeHash);

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
