// A program with cells that are held at values, from its IR.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "compiler/compile.h"
#include "ir/shape/layout.h"

namespace rung::compiler {

// The program's memory and chunks, with other rungs.
struct ForcedProgram {
  // `source` has been kept as it was built. `forced`: in the order of space and byte, each once.
  ForcedProgram(const Compiled& source, std::span<const rung_forced_byte> forced);
  ForcedProgram(const ForcedProgram&) = delete; // the layout is of this module
  ForcedProgram& operator=(const ForcedProgram&) = delete;

  // Those whose rungs are not those of `other`.
  std::vector<uint32_t> chunksUnlike(const ir::Module& other) const;

  ir::Module module;
  ir::Layout layout;
};

} // namespace rung::compiler
