// Compiles units of a program to objects and links them into the process (see jit_code.h).
#include "codegen/jit/jit_code.h"

#include <atomic>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <llvm/ExecutionEngine/Orc/DebugObjectManagerPlugin.h>
#include <llvm/ExecutionEngine/Orc/EPCDebugObjectRegistrar.h>
#include <llvm/ExecutionEngine/Orc/LLJIT.h>
#include <llvm/ExecutionEngine/Orc/ObjectLinkingLayer.h>
#include <llvm/ExecutionEngine/Orc/TargetProcess/JITLoaderGDB.h>

#include "codegen/jit/code_reader.h"
#include "codegen/jit/code_units.h"
#include "codegen/jit/object_cache.h"
#include "codegen/llvm/code_unit_numbers.h"
#include "ir/shape/partition.h"
#include "ir/support/check.h"
#include "ir/support/result.h"
#include "rtlib/run/realtime.h"

namespace rung::codegen {

using namespace ir;

namespace {

std::string textOf(llvm::Error error) { return llvm::toString(std::move(error)); }

// Compiles all units or finds them in the cache, and links each.
class Compiler {
public:
  Compiler(const Layout& layout, uint64_t codeHash, const JitOptions& options, std::string_view machine,
           std::span<const uint32_t> chunks, JitReport& report)
      : layout_(layout), codeHash_(codeHash), options_(options), units_(partitionIntoUnits(layout.partition(), chunks)),
        cache_(options.cacheFolder), report_(report) {
    report_ = {.modules = static_cast<uint32_t>(units_.size())};
    if (options.lengths) report_.lengths.resize(layout.partition().chunks().size());
    shareMembers();
    if (options.cacheFolder.empty()) return;
    const CacheKeys keys(layout, codeHash, options.code, machine);
    for (ModulePart& unit : units_) unit.key = keys.of(unit);
  }

  Result<void> run(llvm::orc::LLJIT& jit, const JitCode::Take& take, const std::atomic<bool>* stop) {
    const auto work = [&] {
      while (stop == nullptr || !stop->load(std::memory_order_relaxed)) {
        const size_t i = next_++;
        if (i >= units_.size()) return;
        doUnit(units_[i], jit, take);
      }
    };
    std::vector<std::thread> helpers;
    for (uint32_t i = 1; i < std::min<size_t>(options_.threads, units_.size()); ++i)
      helpers.emplace_back([&] {
        runtime::becomeHelper();
        work();
      });
    work();
    for (std::thread& helper : helpers) helper.join();
    if (!trouble_.empty()) return failure(trouble_);
    return {};
  }

private:
  void shareMembers() {
    if (!options_.code.debugInfo) return;
    const auto members = std::make_shared<const std::vector<MemoryMember>>(memoryMembers(layout_.memory()));
    for (ModulePart& unit : units_) unit.members = members;
  }

  // Internal errors of the compiler or LLVM fail the unit, and do not end the process.
  Result<std::string> compiled(const ModulePart& unit) {
    CodeUnitCode code;
    Result<std::string> object = contained([&] {
      return compileUnit(layout_, codeHash_, options_.code, unit, options_.lengths ? makeCodeReader(code) : nullptr);
    });
    CodeLengths lengths(std::move(code.functions));
    for (size_t c = 0; c < code.chunks.size(); ++c)
      report_.lengths[unit.firstChunk + c] = lengths.of(code.chunks[c]); // each chunk is in one unit only
    return object;
  }

  void doUnit(const ModulePart& unit, llvm::orc::LLJIT& jit, const JitCode::Take& take) {
    std::optional<std::string> found = cache_.find(unit);
    Result<std::string> object = found ? std::move(*found) : compiled(unit);
    const Result<void> kept = object.ok() && !found ? cache_.keep(unit, object.value()) : Result<void>();
    const std::lock_guard lock(mutex_);
    if (found) ++report_.fromCache;
    if (!kept.ok()) report_.cacheTrouble = kept.error();
    const Result<void> linked = object.ok() ? link(unit, object.value(), jit, take) : object.failure();
    if (!linked.ok()) trouble_ = linked.error();
  }

  // Links each unit into a library of its own, because the names are the same in all units.
  Result<void> link(const ModulePart& unit, const std::string& object, llvm::orc::LLJIT& jit,
                    const JitCode::Take& take) const {
    const std::string name = fmt::format("chunks from {}", unit.firstChunk);
    llvm::Expected<llvm::orc::JITDylib&> library = jit.createJITDylib(name);
    if (!library) return failure(textOf(library.takeError()));
    if (llvm::Error error = defineNumbers(unit, jit, *library)) return failure(textOf(std::move(error)));
    auto bytes = llvm::MemoryBuffer::getMemBufferCopy(object, name);
    if (llvm::Error error = jit.addObjectFile(*library, std::move(bytes))) return failure(textOf(std::move(error)));
    llvm::Expected<llvm::orc::ExecutorAddr> table = jit.lookup(*library, kCodeUnitTable);
    if (!table) return failure(textOf(table.takeError()));
    const auto* functions = table->toPtr<const rung_chunk_fn*>();
    for (uint32_t c = 0; c < unit.chunkCount; ++c) take(unit.firstChunk + c, functions[c]);
    return {};
  }

  llvm::Error defineNumbers(const ModulePart& unit, llvm::orc::LLJIT& jit, llvm::orc::JITDylib& library) const {
    const CodeUnitNumbers numbers(layout_.partition(), unit);
    llvm::orc::SymbolMap symbols;
    for (uint32_t i = 0; const uint32_t value : numbers.values())
      symbols[jit.mangleAndIntern(CodeUnitNumbers::name(i++))] = {llvm::orc::ExecutorAddr(value),
                                                                  llvm::JITSymbolFlags::Exported};
    if (symbols.empty()) return llvm::Error::success();
    return library.define(llvm::orc::absoluteSymbols(std::move(symbols)));
  }

  const Layout& layout_;
  uint64_t codeHash_;
  const JitOptions& options_;
  std::vector<ModulePart> units_;
  ObjectCache cache_;
  std::atomic<size_t> next_{0};
  std::mutex mutex_; // protects the members below, and linking
  JitReport& report_;
  std::string trouble_;
};

// Does what LLVM's enableDebuggerSupport does, which looks for the function by its name, among the global symbols of
// the process: not if LLVM was loaded locally. False: there is no such linker for this kind of machine.
bool showDebugger(llvm::orc::LLJIT& jit) {
  auto* layer = llvm::dyn_cast<llvm::orc::ObjectLinkingLayer>(&jit.getObjLinkingLayer());
  if (layer == nullptr) return false;
  llvm::orc::ExecutionSession& session = jit.getExecutionSession();
  auto registrar = std::make_unique<llvm::orc::EPCDebugObjectRegistrar>(
      session, llvm::orc::ExecutorAddr::fromPtr(&llvm_orc_registerJITLoaderGDBWrapper));
  layer->addPlugin(std::make_unique<llvm::orc::DebugObjectManagerPlugin>(session, std::move(registrar), false, true));
  return true;
}

Result<std::unique_ptr<llvm::orc::LLJIT>> makeLinker(const JitOptions& options) {
  llvm::orc::LLJITBuilder builder;
  builder.setPlatformSetUp(
      llvm::orc::setUpInactivePlatform); // no constructors, no thread-local data: nothing to set up
  llvm::Expected<std::unique_ptr<llvm::orc::LLJIT>> jit = builder.create();
  if (!jit) return failure(textOf(jit.takeError()));
  if (options.gdb && !showDebugger(**jit))
    return failure("the JIT of this machine's kind cannot show code to a debugger");
  return std::move(*jit);
}

class LinkedCode final : public JitCode {
public:
  LinkedCode(const JitOptions& options, std::unique_ptr<llvm::orc::LLJIT> jit, std::string machine)
      : options_(options), jit_(std::move(jit)), machine_(std::move(machine)) {}

  Result<void> compile(const Layout& layout, uint64_t codeHash, std::span<const uint32_t> chunks, const Take& take,
                       const std::atomic<bool>* stop) override {
    return Compiler(layout, codeHash, options_, machine_, chunks, report_).run(*jit_, take, stop);
  }
  const JitReport& report() const override { return report_; }

private:
  JitOptions options_;
  std::unique_ptr<llvm::orc::LLJIT> jit_;
  std::string machine_; // description of the machine that the code is for
  JitReport report_;
};

} // namespace

Result<std::unique_ptr<JitCode>> makeJitCode(const JitOptions& options) {
  if (!options.code.target.empty()) return failure("the JIT makes code for this machine only");
  RUNG_CHECK(!options.lengths || options.cacheFolder.empty(), "what is not compiled has no length");
  Result<std::unique_ptr<llvm::TargetMachine>> machine = makeTargetMachine(options.code, MachineUse::Jit);
  if (!machine.ok()) return machine.failure();
  Result<std::unique_ptr<llvm::orc::LLJIT>> jit = makeLinker(options);
  if (!jit.ok()) return jit.failure();
  return std::unique_ptr<JitCode>(
      std::make_unique<LinkedCode>(options, std::move(jit).value(), describeMachine(*machine.value())));
}

} // namespace rung::codegen
