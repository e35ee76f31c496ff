// The engines (see engines.h).
#include "compiler/engines.h"

#include <array>
#include <cstdlib>
#include <fmt/format.h>

#include "codegen/cpp/cpp_emitter.h"
#include "codegen/llvm/embedded.h"
#include "codegen/llvm/llvm_emitter.h"
#include "codegen/process/process.h"
#include "compiler/object_folder.h"
#include "compiler/tiered.h"
#include "ir/support/put.h"
#include "ir/support/temporary_folder.h"
#include "ir/text/text.h"
#include "rtlib/load/seal.h"
#include "rtlib/load/so_engine.h"

namespace rung::compiler {
namespace {

struct NamedEngine {
  EngineKind kind;
  std::string_view name;
};
constexpr std::array<NamedEngine, 5> kEngines = {{{EngineKind::Interp, "interp"},
                                                  {EngineKind::Cpp, "cpp"},
                                                  {EngineKind::Llvm, "llvm"},
                                                  {EngineKind::Jit, "jit"},
                                                  {EngineKind::Tiered, "tiered"}}};

// A loaded shared object under the name of the engine that made it; the file is not needed once it is loaded.
class BuiltEngine final : public runtime::Engine {
public:
  BuiltEngine(std::unique_ptr<runtime::SoEngine> loaded, std::string_view name)
      : loaded_(std::move(loaded)), name_(name) {}
  const rung_program& program() const override { return loaded_->program(); }
  std::string_view name() const override { return name_; }

private:
  std::unique_ptr<runtime::SoEngine> loaded_;
  std::string_view name_;
};

Result<std::unique_ptr<runtime::Engine>> loaded(std::string_view name, const Result<std::string>& sealedObject) {
  const TemporaryFolder folder;
  if (!folder.ok()) return failure("cannot make a temporary folder");
  if (!sealedObject.ok()) return sealedObject.failure();
  const std::string path = (folder / "program.so").string();
  std::string error = runtime::replaceFile(path, sealedObject.value(), {.mode = runtime::kProgramMode});
  if (!error.empty()) return failure(error);
  std::unique_ptr<runtime::SoEngine> loaded = runtime::SoEngine::open(path, error);
  if (loaded == nullptr) return failure(error);
  return std::unique_ptr<runtime::Engine>(new BuiltEngine(std::move(loaded), name));
}

codegen::LlvmOptions llvmOptions(const EngineOptions& options) {
  codegen::LlvmOptions llvm;
  llvm.level = options.optimise ? codegen::LlvmLevel::Opt : codegen::LlvmLevel::Fast;
  llvm.debugInfo = options.debugger;
  return llvm;
}

Result<std::string> cppObject(const Compiled& compiled, const EngineOptions& options) {
  codegen::CppOptions emit;
  emit.debugInfo = options.debugger;
  codegen::CppBuildOptions build;
  build.compiler = options.cppCompiler.empty() ? defaultCppCompiler() : options.cppCompiler;
  build.optimisation = options.optimise ? "-O2" : "-O0";
  build.debugInfo = options.debugger;
  const std::string text = codegen::emitCpp(*compiled.layout, compiled.codeHash, emit);
  const std::string identity = options.cacheFolder.empty() ? "" : codegen::cppBuildIdentity(text, build);
  return sealedObject(options.cacheFolder, identity, [&] { return codegen::buildCppSharedObject(text, build); });
}

// The back end's version, its options, and everything that it reads of the program.
std::string llvmIdentity(const Compiled& compiled, const EngineOptions& options) {
  std::string identity =
      fmt::format("llvm {} {} {} {}\n", codegen::codeVersion(), RUNG_ABI_VERSION, options.optimise, options.debugger);
  for (const ir::Chunk& chunk : compiled.layout->partition().chunks())
    put(identity, "chunk {} {} {}\n", chunk.routine.index, chunk.firstRung, chunk.rungCount);
  return identity + compiled.layout->memory().text() + ir::print(compiled.layout->module());
}

Result<std::string> llvmObject(const Compiled& compiled, const EngineOptions& options) {
  const std::string identity = options.cacheFolder.empty() ? "" : llvmIdentity(compiled, options);
  return sealedObject(options.cacheFolder, identity, [&] { return sharedObject(compiled, options); });
}

} // namespace

codegen::JitOptions jitOptionsOf(const EngineOptions& options) {
  codegen::JitOptions jit;
  jit.code = llvmOptions(options);
  jit.gdb = options.debugger;
  jit.cacheFolder = options.cacheFolder;
  return jit;
}

ir::Counting countingOf(const EngineOptions& options) {
  return options.countOperations ? ir::Counting::Operations : ir::Counting::Ticks;
}

std::string_view engineName(EngineKind kind) { return kEngines[static_cast<size_t>(kind)].name; }

std::optional<EngineKind> engineFromName(std::string_view name) {
  for (const NamedEngine& engine : kEngines)
    if (engine.name == name) return engine.kind;
  return std::nullopt;
}

std::span<const EngineKind> allEngines() {
  static constexpr std::array kAll = {EngineKind::Interp, EngineKind::Cpp, EngineKind::Llvm, EngineKind::Jit};
  return kAll;
}

std::string defaultCppCompiler() {
  if (const char* named = std::getenv("CXX"); named != nullptr && *named != 0) return named;
  for (const char* candidate : {"clang++-19", "g++"})
    if (codegen::findProgram(candidate)) return candidate;
  return "c++";
}

Result<std::string> sharedObject(const Compiled& compiled, const EngineOptions& options) {
  return codegen::buildLlvmSharedObject(*compiled.layout, compiled.codeHash, llvmOptions(options));
}

Result<std::unique_ptr<runtime::Engine>> makeEngine(EngineKind kind, const Compiled& compiled,
                                                    const EngineOptions& options) {
  const ir::Layout& layout = *compiled.layout;
  switch (kind) {
  case EngineKind::Interp: {
    auto engine = std::make_unique<ir::InterpEngine>(layout, compiled.codeHash, countingOf(options));
    if (options.observer) engine->setObserver(options.observer(compiled));
    return std::unique_ptr<runtime::Engine>(std::move(engine));
  }
  case EngineKind::Cpp: return loaded(engineName(kind), cppObject(compiled, options));
  case EngineKind::Llvm: return loaded(engineName(kind), llvmObject(compiled, options));
  case EngineKind::Jit: {
    Result<std::unique_ptr<codegen::JitEngine>> engine =
        codegen::compileJit(layout, compiled.codeHash, jitOptionsOf(options));
    if (!engine.ok()) return engine.failure();
    return std::unique_ptr<runtime::Engine>(std::move(engine).value());
  }
  case EngineKind::Tiered: {
    Result<std::unique_ptr<TieredEngine>> engine = TieredEngine::make(
        compiled, jitOptionsOf(options), countingOf(options), options.virtualClock ? Pace::Any : Pace::Period);
    if (!engine.ok()) return engine.failure();
    return std::unique_ptr<runtime::Engine>(std::move(engine).value());
  }
  }
  return failure("unknown engine");
}

std::string codeTrouble(runtime::Engine& engine) {
  if (const auto* jit = dynamic_cast<const codegen::JitEngine*>(&engine))
    return cacheTroubleText(jit->report().cacheTrouble);
  auto* tiered = dynamic_cast<TieredEngine*>(&engine);
  return tiered != nullptr ? tiered->problem() : "";
}

} // namespace rung::compiler
