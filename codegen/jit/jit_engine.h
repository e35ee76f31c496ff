// A whole layout as machine code, as an Engine. Does not include LLVM.
#pragma once
#include <memory>
#include <string_view>

#include "codegen/jit/jit_code.h"
#include "rtlib/load/engine.h"

namespace rung::codegen {

class JitEngine final : public runtime::Engine {
public:
  ~JitEngine() override;
  const rung_program& program() const override;
  std::string_view name() const override { return "jit"; }
  const JitReport& report() const;

private:
  struct State;
  explicit JitEngine(std::unique_ptr<State> state);
  friend Result<std::unique_ptr<JitEngine>> compileJit(const ir::Layout& layout, uint64_t codeHash,
                                                       const JitOptions& options);
  std::unique_ptr<State> state_;
};

// `codeHash` goes into the program's tables. The layout need not outlive the engine.
Result<std::unique_ptr<JitEngine>> compileJit(const ir::Layout& layout, uint64_t codeHash, const JitOptions& options);

} // namespace rung::codegen
