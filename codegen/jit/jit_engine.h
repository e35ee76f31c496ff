// JIT: a layout becomes machine code in this process, behind the Engine interface. Free of LLVM.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "codegen/llvm/llvm_emitter.h"
#include "rtlib/host/engine.h"

namespace rung::codegen {

struct JitOptions {
  LlvmOptions code;        // for this machine: `target` is empty
  bool gdb = false;        // tell a debugger of the code
  bool perf = false;       // write a jitdump for `perf inject` (below $JITDUMPDIR, else the home directory)
  std::string cacheFolder; // keeps object files there and takes them from there; empty: no cache
  uint32_t threads = 1;    // that compile at the same time
};

struct JitReport {
  uint32_t modules = 0;     // pieces that the program was compiled in
  uint32_t fromCache = 0;   // of them
  std::string cacheTrouble; // why a piece could not be kept; the code is good all the same
};

class JitEngine final : public host::Engine {
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
