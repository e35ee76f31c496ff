// JIT: compiles the chunks of a layout to machine code in this process. Does not include LLVM.
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
  LlvmOptions code;        // for this computer: `target` is empty
  bool gdb = false;        // register the code with a debugger
  std::string cacheFolder; // object files are stored there and loaded from there; empty: no cache
  uint32_t threads = 1;    // number of threads that compile at the same time
  bool lengths = false;    // report the length of the code; without a cache
};

struct JitReport {
  uint32_t modules = 0;            // number of code units of the program
  uint32_t fromCache = 0;          // how many of them came from the cache
  std::string cacheTrouble;        // why a unit could not be cached; the code is valid all the same
  std::vector<CodeLength> lengths; // with JitOptions::lengths: by chunk of the layout
};

// Machine code of chunks, compiled unit by unit.
class JitCode {
public:
  // Called by any of the compiling threads, one at a time.
  using Take = std::function<void(uint32_t chunk, rung_chunk_fn function)>;

  virtual ~JitCode() = default;

  // `chunks`: ascending, each compiled once in the life of the code. `take` is called with the chunks of a unit once
  // the unit is compiled; their functions stay valid as long as the code, also after a failure. Ends early, without an
  // error, if `stop` (which may be null) becomes true. `codeHash`: of the whole program, for the cache.
  virtual Result<void> compile(const ir::Layout& layout, uint64_t codeHash, std::span<const uint32_t> chunks,
                               const Take& take, const std::atomic<bool>* stop) = 0;
  virtual const JitReport& report() const = 0; // of the last compilation
};

Result<std::unique_ptr<JitCode>> makeJitCode(const JitOptions& options);

} // namespace rung::codegen
