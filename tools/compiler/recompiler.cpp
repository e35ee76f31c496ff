// Chunks with forced cells (see recompiler.h).
#include "tools/compiler/recompiler.h"

#include <algorithm>

#include "codegen/jit/jit_engine.h"
#include "ir/interp/interp.h"
#include "ir/passes/force.h"

namespace rung::compiler {
namespace {

bool sameCode(const ir::Rung& a, const ir::Rung& b) {
  return a.ops == b.ops && a.args == b.args && a.transfer == b.transfer;
}

// The program's memory and chunks, with other rungs.
struct ForcedProgram {
  ForcedProgram(const Compiled& source, std::span<const rung_forced_byte> forced)
      : module(changed(source, forced)), layout(source.layout->over(module)) {}
  ForcedProgram(const ForcedProgram&) = delete; // the layout is of this module
  ForcedProgram& operator=(const ForcedProgram&) = delete;

  static ir::Module changed(const Compiled& source, std::span<const rung_forced_byte> forced) {
    ir::Module module = *source.built;
    ir::forceBits(module, forced);
    ir::runPasses(module, source.passes);
    return module;
  }

  // Those whose rungs are not those of `other`.
  std::vector<uint32_t> chunksUnlike(const ir::Module& other) const {
    std::vector<uint32_t> unlike;
    for (uint32_t i = 0; i < layout.chunks().size(); ++i) {
      const ir::Chunk& chunk = layout.chunks()[i];
      const auto here = module.at(chunk.routine).rungs.begin() + chunk.firstRung;
      const auto there = other.at(chunk.routine).rungs.begin() + chunk.firstRung;
      if (!std::equal(here, here + chunk.rungCount, there, sameCode)) unlike.push_back(i);
    }
    return unlike;
  }

  ir::Module module;
  ir::Layout layout;
};

class InterpretedCode final : public ForcedCode {
public:
  InterpretedCode(const Compiled& source, const EngineOptions& options, const rung_program& running,
                  std::span<const rung_forced_byte> forced)
      : program_(source, forced), engine_(program_.layout, running.code_hash, countingOf(options)) {
    if (options.observer) engine_.setObserver(options.observer(source));
    code_ = {engine_.program().chunk_fns, engine_.context()};
  }

private:
  ForcedProgram program_;
  ir::InterpEngine engine_;
};

class NativeCode final : public ForcedCode {
public:
  NativeCode(std::unique_ptr<codegen::JitChunks> changed, const rung_program& running, void* engine)
      : changed_(std::move(changed)), functions_(running.chunk_fns, running.chunk_fns + running.chunk_count) {
    for (const codegen::JitChunks::Chunk& chunk : changed_->chunks()) functions_[chunk.number] = chunk.function;
    code_ = {functions_.data(), engine};
  }

private:
  std::unique_ptr<codegen::JitChunks> changed_;
  std::vector<rung_chunk_fn> functions_;
};

} // namespace

Result<std::unique_ptr<ForcedCode>> makeForcedCode(const Compiled& source, EngineKind kind,
                                                   const EngineOptions& options, const rung_program& running,
                                                   void* engine, std::span<const rung_forced_byte> forced) {
  if (kind == EngineKind::Interp)
    return std::unique_ptr<ForcedCode>(std::make_unique<InterpretedCode>(source, options, running, forced));
  const ForcedProgram program(source, forced);
  Result<std::unique_ptr<codegen::JitChunks>> chunks =
      codegen::compileChunks(program.layout, program.chunksUnlike(*source.module), jitOptionsOf(options));
  if (!chunks.ok()) return chunks.failure();
  return std::unique_ptr<ForcedCode>(std::make_unique<NativeCode>(std::move(chunks).value(), running, engine));
}

} // namespace rung::compiler
