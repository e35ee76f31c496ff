// A program that runs at once and gets faster while it runs: first in the interpreter, then as machine code, chunk by
// chunk as it is compiled. Either code of a chunk does the same, so it can be exchanged at any moment, at no cost to
// the running program.
//
// If the interpreter might exceed the period of the schedule, because the program is long or may loop, or might
// allocate memory, the program begins with machine code that is compiled fast, and the creation of the engine waits for
// it. On a virtual clock, where no time passes meanwhile, it always begins in the interpreter.
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

// The functions of a program's chunks, and other tables that follow it except for some chunks.
class TierTables {
public:
  TierTables(size_t chunks, rung_chunk_fn first) : functions_(chunks, first) {}

  const rung_chunk_fn* functions() const { return functions_.data(); }
  // May be called on any thread, while chunks run.
  void set(uint32_t chunk, rung_chunk_fn function);
  // From now on `table` has the same functions, except for chunks with own[chunk]. Both arguments must stay in place
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

// The deadline for the first code of a program.
enum class Pace : uint8_t {
  Period, // the period of the schedule
  Any,    // none: the clock is virtual
};

// A sentence about JitReport::cacheTrouble; "" if that is empty.
std::string cacheTroubleText(const std::string& trouble);

class TieredEngine final : public runtime::Engine {
public:
  // The layout of `compiled` must outlive the engine. The level in `options` is that of the final code, which is
  // compiled on all cores.
  static Result<std::unique_ptr<TieredEngine>> make(const Compiled& compiled, const codegen::JitOptions& options,
                                                    ir::Counting counting, Pace pace = Pace::Period);
  // Ends compilation early, except for code that is to be cached.
  ~TieredEngine() override;

  const rung_program& program() const override { return program_; }
  std::string_view name() const override { return "tiered"; }
  void* context() override { return this; }
  // The function of a chunk that is interpreted.
  static uint32_t interpret(uint8_t* mem, rung_ctx* ctx, uint32_t chunk);

  const std::shared_ptr<TierTables>& tables() const { return tables_; }
  // The measured bound of the interpreter; empty with Pace::Any.
  const runtime::ScanBound& bound() const { return bound_; }
  bool beganInterpreted() const { return fast_ == nullptr; }
  // Number of chunks that have their final code. May be called on any thread.
  uint32_t finishedChunks() const { return finished_.load(); }
  // Waits until all chunks have their final code, or cannot have it. Returns why not, or what is wrong with the cache,
  // or "".
  std::string finish();
  // Like finish(), but waits only for code that is to be cached.
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
  std::unique_ptr<codegen::JitCode> fast_; // if the program began with machine code
  std::unique_ptr<codegen::JitCode> code_; // the final code; used by thread_ alone as long as that runs
  std::atomic<uint32_t> finished_{0};
  std::atomic<bool> stop_{false};
  std::string problem_;            // valid once ended_ is true
  std::atomic<bool> ended_{false}; // whether compilation has ended
  std::thread thread_;
};

} // namespace rung::compiler
