// JIT: a layout becomes machine code in this process, behind the Engine interface. Free of LLVM.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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

// Code of some chunks of a program, to run in the place of what the program has for them.
class JitChunks {
public:
  ~JitChunks();
  struct Chunk {
    uint32_t number = 0;
    rung_chunk_fn function = nullptr;
  };
  std::span<const Chunk> chunks() const { return chunks_; }

private:
  struct State;
  explicit JitChunks(std::unique_ptr<State> state, std::vector<Chunk> chunks);
  friend Result<std::unique_ptr<JitChunks>> compileChunks(const ir::Layout& layout, std::span<const uint32_t> chunks,
                                                          const JitOptions& options);
  std::unique_ptr<State> state_;
  std::vector<Chunk> chunks_;
};

// `chunks`: ascending. Without a cache. The layout need not outlive the code.
Result<std::unique_ptr<JitChunks>> compileChunks(const ir::Layout& layout, std::span<const uint32_t> chunks,
                                                 const JitOptions& options);

// `codeHash` goes into the program's tables. The layout need not outlive the engine.
Result<std::unique_ptr<JitEngine>> compileJit(const ir::Layout& layout, uint64_t codeHash, const JitOptions& options);

} // namespace rung::codegen
