// Compiles pieces of a program to objects and links them into the process (see jit_engine.h).
#include "codegen/jit/jit_engine.h"

#include <atomic>
#include <mutex>
#include <numeric>
#include <thread>

#include <fmt/format.h>
#include <llvm/ExecutionEngine/JITEventListener.h>
#include <llvm/ExecutionEngine/Orc/Debugging/DebuggerSupport.h>
#include <llvm/ExecutionEngine/Orc/LLJIT.h>
#include <llvm/ExecutionEngine/Orc/RTDyldObjectLinkingLayer.h>
#include <llvm/ExecutionEngine/SectionMemoryManager.h>

#include "codegen/jit/object_cache.h"
#include "codegen/llvm/llvm_module.h"
#include "ir/layout/program_image.h"

namespace rung::codegen {

using namespace ir;

struct JitEngine::State {
  State(const Layout& layout, uint64_t codeHash) : image(layout, codeHash) {}

  ProgramImage image;
  std::unique_ptr<llvm::orc::LLJIT> jit;
  std::vector<rung_chunk_fn> functions; // by chunk
  JitReport report;
};

namespace {

// Small enough that two threads share the work and that memory stays flat, large enough that a piece's own cost
// vanishes.
constexpr uint32_t kRungsPerPiece = 2048;

std::string textOf(llvm::Error error) { return llvm::toString(std::move(error)); }

// Each of chunks that follow one another.
std::vector<ModulePart> cutPieces(const Layout& layout, std::span<const uint32_t> chunks) {
  std::vector<ModulePart> pieces;
  uint32_t rungs = kRungsPerPiece;
  for (const uint32_t chunk : chunks) {
    const bool follows = !pieces.empty() && pieces.back().firstChunk + pieces.back().chunkCount == chunk;
    if (rungs >= kRungsPerPiece || !follows) {
      pieces.push_back({.firstChunk = chunk, .tableName = fmt::format("rung_chunks_{}", chunk)});
      rungs = 0;
    }
    ++pieces.back().chunkCount;
    rungs += layout.chunks()[chunk].rungCount;
  }
  return pieces;
}

Result<std::string> compilePiece(const Layout& layout, uint64_t codeHash, const LlvmOptions& options,
                                 const ModulePart& piece) {
  Result<std::unique_ptr<llvm::TargetMachine>> machine = makeTargetMachine(options, MachineUse::Jit);
  if (!machine.ok()) return machine.failure();
  llvm::LLVMContext context;
  context.setDiscardValueNames(true);
  Result<std::unique_ptr<llvm::Module>> module =
      buildModule(context, *machine.value(), layout, codeHash, options, piece);
  if (!module.ok()) return module.failure();
  runPasses(*module.value(), *machine.value(), options.level);
  return generateCode(*module.value(), *machine.value(), llvm::CodeGenFileType::ObjectFile);
}

// Compiles or finds all pieces; `report` tells how many of each.
class Compiler {
public:
  Compiler(const Layout& layout, uint64_t codeHash, const JitOptions& options, std::string_view machine,
           std::span<const uint32_t> chunks, JitReport& report)
      : layout_(layout), codeHash_(codeHash), options_(options), pieces_(cutPieces(layout, chunks)),
        objects_(pieces_.size()), cache_(options.cacheFolder), report_(report) {
    if (options.cacheFolder.empty()) return;
    const CacheKeys keys(layout, codeHash, options.code, machine);
    for (ModulePart& piece : pieces_) piece.key = keys.of(piece);
  }

  Result<void> run() {
    report_.modules = static_cast<uint32_t>(pieces_.size());
    std::vector<std::thread> helpers;
    for (uint32_t i = 1; i < std::min<size_t>(options_.threads, pieces_.size()); ++i)
      helpers.emplace_back([this] { work(); });
    work();
    for (std::thread& helper : helpers) helper.join();
    if (!trouble_.empty()) return failure(trouble_);
    return {};
  }

  const std::vector<ModulePart>& pieces() const { return pieces_; }
  std::string& object(size_t piece) { return objects_[piece]; }

private:
  void work() {
    for (uint32_t i = next_++; i < pieces_.size(); i = next_++) {
      if (std::optional<std::string> found = cache_.find(pieces_[i])) {
        objects_[i] = std::move(*found);
        const std::lock_guard lock(mutex_);
        ++report_.fromCache;
        continue;
      }
      Result<std::string> made = compilePiece(layout_, codeHash_, options_.code, pieces_[i]);
      Result<void> kept = made.ok() ? cache_.keep(pieces_[i], made.value()) : Result<void>();
      const std::lock_guard lock(mutex_);
      if (!made.ok())
        trouble_ = made.error();
      else
        objects_[i] = std::move(made).value();
      if (!kept.ok()) report_.cacheTrouble = kept.error();
    }
  }

  const Layout& layout_;
  uint64_t codeHash_;
  const JitOptions& options_;
  std::vector<ModulePart> pieces_;
  std::vector<std::string> objects_;
  ObjectCache cache_;
  std::atomic<uint32_t> next_{0};
  std::mutex mutex_; // of what follows
  JitReport& report_;
  std::string trouble_;
};

// JITLink is LLVM's newer linker, but only the older one gives perf the lines of functions that are not exported.
Result<std::unique_ptr<llvm::orc::LLJIT>> makeLinker(const JitOptions& options) {
  llvm::orc::LLJITBuilder builder;
  builder.setPlatformSetUp(
      llvm::orc::setUpInactivePlatform); // no constructors, no thread-local data: nothing to set up
  if (options.perf)
    builder.setObjectLinkingLayerCreator([&](llvm::orc::ExecutionSession& session, const llvm::Triple&) {
      auto layer = std::make_unique<llvm::orc::RTDyldObjectLinkingLayer>(
          session, [] { return std::make_unique<llvm::SectionMemoryManager>(); });
      if (llvm::JITEventListener* listener = llvm::JITEventListener::createPerfJITEventListener())
        layer->registerJITEventListener(*listener);
      if (options.gdb) layer->registerJITEventListener(*llvm::JITEventListener::createGDBRegistrationListener());
      return layer;
    });
  llvm::Expected<std::unique_ptr<llvm::orc::LLJIT>> jit = builder.create();
  if (!jit) return failure(textOf(jit.takeError()));
  if (options.gdb && !options.perf)
    if (llvm::Error error = llvm::orc::enableDebuggerSupport(**jit)) return failure(textOf(std::move(error)));
  return std::move(*jit);
}

// Gives each chunk's number and function to `take`, in their order.
template <class Take>
Result<std::unique_ptr<llvm::orc::LLJIT>> compileAndLink(const Layout& layout, uint64_t codeHash,
                                                         const JitOptions& options, std::span<const uint32_t> chunks,
                                                         JitReport& report, Take take) {
  if (!options.code.target.empty()) return failure("the JIT makes code for this machine only");
  Result<std::unique_ptr<llvm::TargetMachine>> machine = makeTargetMachine(options.code, MachineUse::Jit);
  if (!machine.ok()) return machine.failure();
  Compiler compiler(layout, codeHash, options, describeMachine(*machine.value()), chunks, report);
  if (Result<void> compiled = compiler.run(); !compiled.ok()) return compiled.failure();
  Result<std::unique_ptr<llvm::orc::LLJIT>> linker = makeLinker(options);
  if (!linker.ok()) return linker.failure();
  llvm::orc::LLJIT& jit = *linker.value();
  for (size_t i = 0; i < compiler.pieces().size(); ++i) {
    const ModulePart& piece = compiler.pieces()[i];
    auto bytes = llvm::MemoryBuffer::getMemBufferCopy(compiler.object(i), piece.tableName);
    if (llvm::Error error = jit.addObjectFile(std::move(bytes))) return failure(textOf(std::move(error)));
    llvm::Expected<llvm::orc::ExecutorAddr> table = jit.lookup(piece.tableName);
    if (!table) return failure(textOf(table.takeError()));
    const auto* functions = table->toPtr<const rung_chunk_fn*>();
    for (uint32_t c = 0; c < piece.chunkCount; ++c) take(piece.firstChunk + c, functions[c]);
  }
  return linker;
}

} // namespace

JitEngine::JitEngine(std::unique_ptr<State> state) : state_(std::move(state)) {}
JitEngine::~JitEngine() = default;
const rung_program& JitEngine::program() const { return state_->image.program(); }
const JitReport& JitEngine::report() const { return state_->report; }

Result<std::unique_ptr<JitEngine>> compileJit(const Layout& layout, uint64_t codeHash, const JitOptions& options) {
  auto state = std::make_unique<JitEngine::State>(layout, codeHash);
  std::vector<uint32_t> all(layout.chunks().size());
  std::iota(all.begin(), all.end(), 0);
  Result<std::unique_ptr<llvm::orc::LLJIT>> jit =
      compileAndLink(layout, codeHash, options, all, state->report,
                     [&](uint32_t, rung_chunk_fn function) { state->functions.push_back(function); });
  if (!jit.ok()) return jit.failure();
  state->jit = std::move(jit).value();
  state->image.program().chunk_fns = state->functions.data();
  return std::unique_ptr<JitEngine>(new JitEngine(std::move(state)));
}

struct JitChunks::State {
  std::unique_ptr<llvm::orc::LLJIT> jit;
};

JitChunks::JitChunks(std::unique_ptr<State> state, std::vector<Chunk> chunks)
    : state_(std::move(state)), chunks_(std::move(chunks)) {}
JitChunks::~JitChunks() = default;

Result<std::unique_ptr<JitChunks>> compileChunks(const Layout& layout, std::span<const uint32_t> chunks,
                                                 const JitOptions& options) {
  JitOptions uncached = options;
  uncached.cacheFolder.clear();
  JitReport report;
  std::vector<JitChunks::Chunk> made;
  Result<std::unique_ptr<llvm::orc::LLJIT>> jit =
      compileAndLink(layout, 0, uncached, chunks, report, [&](uint32_t number, rung_chunk_fn function) {
        made.push_back({.number = number, .function = function});
      });
  if (!jit.ok()) return jit.failure();
  auto state = std::make_unique<JitChunks::State>(std::move(jit).value());
  return std::unique_ptr<JitChunks>(new JitChunks(std::move(state), std::move(made)));
}

} // namespace rung::codegen
