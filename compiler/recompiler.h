// Other code for a program that is compiled already: its chunks with cells that are held at values.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "compiler/compile.h"
#include "compiler/engines.h"
#include "ir/shape/layout.h"
#include "rtlib/core/runner.h"

namespace rung::compiler {

// Code for all chunks of a program: its own, but for those that would write forced bits.
class ForcedCode {
public:
  virtual ~ForcedCode() = default;
  const core::Code& code() const { return code_; }

protected:
  core::Code code_;
};

// `compiled` has been kept as it was built. `running` is the program whose code is replaced, and `engine` what its
// chunks find in their context; both outlive the result. `forced`: in the order of space and byte, each once.
Result<std::unique_ptr<ForcedCode>> makeForcedCode(const Compiled& compiled, EngineKind kind,
                                                   const EngineOptions& options, const rung_program& running,
                                                   void* engine, std::span<const rung_forced_byte> forced);

// A program with cells that are held at values, from its IR.

// The program's memory and chunks, with other rungs.
struct ForcedProgram {
  // `source` has been kept as it was built. `forced`: in the order of space and byte, each once.
  ForcedProgram(const Compiled& source, std::span<const rung_forced_byte> forced);
  ForcedProgram(const ForcedProgram&) = delete; // the layout is of this module
  ForcedProgram& operator=(const ForcedProgram&) = delete;

  // Those whose rungs are not those of `other`.
  std::vector<uint32_t> changedChunks(const ir::Module& other) const;

  ir::Module module;
  ir::Layout layout;
};

} // namespace rung::compiler
