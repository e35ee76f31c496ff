// JIT: chunks of a layout become machine code in this process. Free of LLVM.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "codegen/jit/code_paths.h"
#include "codegen/llvm/llvm_emitter.h"
#include "rung/program.h"

namespace rung::codegen {

struct JitOptions {
  LlvmOptions code;        // for this machine: `target` is empty
  bool gdb = false;        // make the code known to a debugger
  std::string cacheFolder; // keeps object files there and takes them from there; empty: no cache
  uint32_t threads = 1;    // that compile at the same time
  bool lengths = false;    // report how long the code is; without a cache
};

struct JitReport {
  uint32_t modules = 0;            // units that the program was compiled in
  uint32_t fromCache = 0;          // of them
  std::string cacheTrouble;        // why a unit could not be kept; the code is good all the same
  std::vector<CodeLength> lengths; // with JitOptions::lengths: by chunk of the layout
};

// Machine code of chunks, for the units of a program one after the other.
class JitCode {
public:
  // One thread at a time calls it, any of those that compile.
  using Take = std::function<void(uint32_t chunk, rung_chunk_fn function)>;

  virtual ~JitCode() = default;

  // `chunks`: ascending, each once in the life of the code. Those of a unit are taken once the unit is there, and
  // stay as long as the code, also after a failure. Ends early, and with success, when `stop` (which may be null) says
  // so. `codeHash`: of the whole program, for the cache.
  virtual Result<void> compile(const ir::Layout& layout, uint64_t codeHash, std::span<const uint32_t> chunks,
                               const Take& take, const std::atomic<bool>* stop) = 0;
  virtual const JitReport& report() const = 0; // of the last compilation
};

Result<std::unique_ptr<JitCode>> makeJitCode(const JitOptions& options);

} // namespace rung::codegen
