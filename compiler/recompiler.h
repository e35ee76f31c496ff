// Recompiles chunks of a program with cells that are forced to values.
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

// Code for all chunks of a program: its own, except for chunks that would write forced bits.
class ForcedCode {
public:
  virtual ~ForcedCode() = default;
  const core::Code& code() const { return code_; }

protected:
  core::Code code_;
};

// `compiled` must have its module as built (keepBuilt). `running` is the program whose code is replaced, and `engine`
// the context of its chunks; both must outlive the result. `forced`: ordered by space and byte, each once.
Result<std::unique_ptr<ForcedCode>> makeForcedCode(const Compiled& compiled, EngineKind kind,
                                                   const EngineOptions& options, const rung_program& running,
                                                   void* engine, std::span<const rung_forced_byte> forced);

// The IR of a program with forced cells.

// The program with its memory and chunks, but changed rungs.
struct ForcedProgram {
  // `source` must have its module as built (keepBuilt). `forced`: ordered by space and byte, each once.
  ForcedProgram(const Compiled& source, std::span<const rung_forced_byte> forced);
  ForcedProgram(const ForcedProgram&) = delete; // the layout refers to the member `module`
  ForcedProgram& operator=(const ForcedProgram&) = delete;

  // The chunks whose rungs differ from those of `other`.
  std::vector<uint32_t> changedChunks(const ir::Module& other) const;

  ir::Module module;
  ir::Layout layout;
};

} // namespace rung::compiler
