// A program that runs at once and gets faster while it runs: first in the interpreter, then as machine code, chunk by
// chunk as that is compiled. Whichever code a chunk has does the same, so it is exchanged at any moment; it costs a
// running program nothing.
//
// Where the interpreter may need more than the period of the schedule, because the program is long or may go in loops,
// or memory from the heap, the program begins with machine code that is compiled fast, and the creation of the engine
// waits for it. On a virtual clock, where no time passes meanwhile, it begins in the interpreter in any case.
#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "codegen/jit/jit_code.h"
#include "compiler/compile.h"
#include "ir/interp/interp.h"
#include "rtlib/load/engine.h"
#include "rtlib/run/scan_bound.h"

namespace rung::compiler {

// The functions of a program's chunks, and tables that have the same ones but for some of their own.
class TierTables {
public:
  TierTables(size_t chunks, rung_chunk_fn first) : functions_(chunks, first) {}

  const rung_chunk_fn* functions() const { return functions_.data(); }
  // Any thread, while chunks run.
  void set(uint32_t chunk, rung_chunk_fn function);
  // From now on `table` has the functions of all chunks but those of which `own` says yes. Both stay where they are
  // until `unfollow`.
  void follow(std::span<rung_chunk_fn> table, const std::vector<bool>& own);
  void unfollow(std::span<rung_chunk_fn> table);

private:
  struct Follower {
    std::span<rung_chunk_fn> table;
    const std::vector<bool>* own;
  };
  std::mutex mutex_;
  std::vector<rung_chunk_fn> functions_; // by chunk
  std::vector<Follower> followers_;
};

// What the first code of a program has to keep up with.
enum class Pace : uint8_t {
  Period, // of the schedule
  Any,    // nothing: the clock is virtual
};

// A sentence on JitReport::cacheTrouble; "" when there is none.
std::string cacheTroubleText(const std::string& trouble);

class TieredEngine final : public runtime::Engine {
public:
  // The layout of `compiled` outlives the engine. Of the options the level is that of the code in the end; it is
  // compiled on all cores.
  static Result<std::unique_ptr<TieredEngine>> make(const Compiled& compiled, const codegen::JitOptions& options,
                                                    ir::Counting counting, Pace pace = Pace::Period);
  // Compilation ends early, but for code that a cache keeps.
  ~TieredEngine() override;

  const rung_program& program() const override { return program_; }
  std::string_view name() const override { return "tiered"; }
  void* context() override { return this; }
  // The code of a chunk that is interpreted.
  static uint32_t interpret(uint8_t* mem, rung_ctx* ctx, uint32_t chunk);

  const std::shared_ptr<TierTables>& tables() const { return tables_; }
  // What the interpreter may need, as it was measured; nothing where the pace is any.
  const runtime::ScanBound& bound() const { return bound_; }
  bool beganInterpreted() const { return fast_ == nullptr; }
  // Chunks that have the code they are to have in the end. Any thread.
  uint32_t finishedChunks() const { return finished_.load(); }
  // Waits until all have, or cannot have it; then why not, or what is wrong with the cache, or "".
  std::string finish();
  // The same as far as it is known; only what a cache keeps is waited for.
  std::string problem();

private:
  TieredEngine(const Compiled& compiled, const codegen::JitOptions& options, ir::Counting counting);
  Result<void> begin(Pace pace);
  bool keepsPeriod();
  Result<std::unique_ptr<codegen::JitCode>> codeOf(codegen::LlvmLevel level);
  Result<void> compile(codegen::JitCode& code, std::atomic<uint32_t>& done);
  void work();
  Result<void> makeCode();

  const ir::Layout& layout_;
  uint64_t codeHash_;
  codegen::JitOptions options_;
  ir::InterpEngine interpreter_;
  std::shared_ptr<TierTables> tables_;
  rung_program program_;
  runtime::ScanBound bound_;
  std::unique_ptr<codegen::JitCode> fast_; // where the program began with it
  std::unique_ptr<codegen::JitCode> code_; // in the end; the thread's as long as it runs
  std::atomic<uint32_t> finished_{0};
  std::atomic<bool> stop_{false};
  std::string problem_;            // once it has
  std::atomic<bool> ended_{false}; // compilation
  std::thread thread_;
};

} // namespace rung::compiler
