// Chooses the first code of a program, and compiles the rest on a thread (see tiered.h).
#include "compiler/tiered.h"

#include <algorithm>
#include <numeric>

#include "rtlib/run/realtime.h"

namespace rung::compiler {

// ---- tables --------------------------------------------------------------------------------------------------------

std::string cacheTroubleText(const std::string& trouble) {
  return trouble.empty() ? "" : "nothing is taken from or kept in the cache: " + trouble;
}

namespace {

void exchange(rung_chunk_fn& entry, rung_chunk_fn function) {
  std::atomic_ref<rung_chunk_fn>(entry).store(function, std::memory_order_release);
}

} // namespace

void TierTables::set(uint32_t chunk, rung_chunk_fn function) {
  const std::lock_guard lock(mutex_);
  exchange(functions_[chunk], function);
  for (const Follower& follower : followers_)
    if (!(*follower.own)[chunk]) exchange(follower.table[chunk], function);
}

void TierTables::follow(std::span<rung_chunk_fn> table, const std::vector<bool>& own) {
  const std::lock_guard lock(mutex_);
  for (size_t chunk = 0; chunk < table.size(); ++chunk)
    if (!own[chunk]) exchange(table[chunk], functions_[chunk]);
  followers_.push_back({.table = table, .own = &own});
}

void TierTables::unfollow(std::span<rung_chunk_fn> table) {
  const std::lock_guard lock(mutex_);
  std::erase_if(followers_, [&](const Follower& follower) { return follower.table.data() == table.data(); });
}

// ---- engine --------------------------------------------------------------------------------------------------------

TieredEngine::TieredEngine(const Compiled& compiled, const codegen::JitOptions& options, ir::Counting counting)
    : layout_(*compiled.layout), codeHash_(compiled.codeHash), options_(options),
      interpreter_(*compiled.layout, compiled.codeHash, counting),
      tables_(std::make_shared<TierTables>(compiled.layout->partition().chunks().size(), &interpret)),
      program_(interpreter_.program()) {
  options_.threads = std::max(1u, std::thread::hardware_concurrency());
  program_.chunk_fns = tables_->functions();
}

TieredEngine::~TieredEngine() {
  stop_ = options_.cacheFolder.empty();
  if (thread_.joinable()) thread_.join();
}

uint32_t TieredEngine::interpret(uint8_t* mem, rung_ctx* ctx, uint32_t chunk) {
  return static_cast<const TieredEngine*>(ctx->engine)->interpreter_.runChunk(mem, *ctx, chunk);
}

Result<std::unique_ptr<TieredEngine>> TieredEngine::make(const Compiled& compiled, const codegen::JitOptions& options,
                                                         ir::Counting counting, Pace pace) {
  std::unique_ptr<TieredEngine> engine(new TieredEngine(compiled, options, counting));
  if (const Result<void> begun = engine->begin(pace); !begun.ok()) return begun.failure();
  return engine;
}

// Whether the interpreter keeps the period.
bool TieredEngine::keepsPeriod() {
  bound_ = runtime::measureBound({.program = program_, .engine = this});
  return !interpreter_.allocates() && !bound_.loops && bound_.fits();
}

Result<void> TieredEngine::begin(Pace pace) {
  if (pace == Pace::Period && !keepsPeriod()) {
    Result<std::unique_ptr<codegen::JitCode>> fast = codeOf(codegen::LlvmLevel::Fast);
    if (!fast.ok()) return fast.failure();
    fast_ = std::move(fast).value();
    std::atomic<uint32_t> done = 0;
    const bool isLast = options_.code.level == codegen::LlvmLevel::Fast;
    if (const Result<void> compiled = compile(*fast_, isLast ? finished_ : done); !compiled.ok()) return compiled;
    if (isLast) {
      problem_ = cacheTroubleText(fast_->report().cacheTrouble);
      ended_ = true;
      return {};
    }
  }
  thread_ = std::thread([this] { work(); });
  return {};
}

Result<std::unique_ptr<codegen::JitCode>> TieredEngine::codeOf(codegen::LlvmLevel level) {
  codegen::JitOptions options = options_;
  options.code.level = level;
  return codegen::makeJitCode(options);
}

Result<void> TieredEngine::compile(codegen::JitCode& code, std::atomic<uint32_t>& done) {
  std::vector<uint32_t> all(layout_.partition().chunks().size());
  std::iota(all.begin(), all.end(), 0);
  const auto take = [&](uint32_t chunk, rung_chunk_fn function) {
    tables_->set(chunk, function);
    ++done;
  };
  return code.compile(layout_, codeHash_, all, take, &stop_);
}

void TieredEngine::work() {
  runtime::becomeHelper();
  const Result<void> done = makeCode();
  problem_ =
      done.ok() ? cacheTroubleText(code_->report().cacheTrouble) : "no machine code can be made: " + done.error();
  ended_ = true;
}

// Runs beside the program, because LLVM takes some milliseconds until it is ready.
Result<void> TieredEngine::makeCode() {
  Result<std::unique_ptr<codegen::JitCode>> code = codeOf(options_.code.level);
  if (!code.ok()) return code.failure();
  code_ = std::move(code).value();
  return compile(*code_, finished_);
}

std::string TieredEngine::finish() {
  if (thread_.joinable()) thread_.join();
  return problem_;
}

std::string TieredEngine::problem() {
  if (!options_.cacheFolder.empty()) return finish();
  return ended_ ? problem_ : "";
}

} // namespace rung::compiler
