// Recompiles chunks with forced cells.
#include "compiler/recompiler.h"

#include <algorithm>

#include "codegen/jit/jit_code.h"
#include "compiler/tiered.h"
#include "ir/interp/interp.h"
#include "ir/shape/partition.h"
#include "ir/transforms/force.h"
#include "ir/transforms/pipeline.h"

namespace rung::compiler {

namespace {

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
  NativeCode(const rung_program& running, void* engine)
      : functions_(running.chunk_count), isChanged_(running.chunk_count) {
    code_ = {functions_.data(), engine};
  }
  ~NativeCode() override {
    if (tiers_ != nullptr) tiers_->unfollow(functions_);
  }

  Result<void> change(const ForcedProgram& program, std::span<const uint32_t> chunks,
                      const codegen::JitOptions& options) {
    for (const uint32_t chunk : chunks) isChanged_[chunk] = true;
    Result<std::unique_ptr<codegen::JitCode>> code = codegen::makeJitCode(options);
    if (!code.ok()) return code.failure();
    changed_ = std::move(code).value();
    const auto take = [&](uint32_t chunk, rung_chunk_fn function) { functions_[chunk] = function; };
    return changed_->compile(program.layout, 0, chunks, take, nullptr);
  }

  // Takes all other chunks from the program, which has them or will have them.
  void keep(const rung_chunk_fn* functions) {
    for (size_t chunk = 0; chunk < functions_.size(); ++chunk)
      if (!isChanged_[chunk]) functions_[chunk] = functions[chunk];
  }
  void keep(std::shared_ptr<TierTables> tiers) {
    tiers_ = std::move(tiers);
    tiers_->follow(functions_, isChanged_);
  }

private:
  std::unique_ptr<codegen::JitCode> changed_;
  std::vector<rung_chunk_fn> functions_; // by chunk
  std::vector<bool> isChanged_;
  std::shared_ptr<TierTables> tiers_;
};

} // namespace

Result<std::unique_ptr<ForcedCode>> makeForcedCode(const Compiled& source, EngineKind kind,
                                                   const EngineOptions& options, const rung_program& running,
                                                   void* engine, std::span<const rung_forced_byte> forced) {
  if (kind == EngineKind::Interp)
    return std::unique_ptr<ForcedCode>(std::make_unique<InterpretedCode>(source, options, running, forced));
  const ForcedProgram program(source, forced);
  auto code = std::make_unique<NativeCode>(running, engine);
  codegen::JitOptions jit = jitOptionsOf(options);
  jit.cacheFolder.clear();
  const Result<void> changed = code->change(program, program.changedChunks(*source.module), jit);
  if (!changed.ok()) return changed.failure();
  if (kind == EngineKind::Tiered)
    code->keep(static_cast<const TieredEngine*>(engine)->tables());
  else
    code->keep(running.chunk_fns);
  return std::unique_ptr<ForcedCode>(std::move(code));
}

namespace {

bool sameCode(const ir::Rung& a, const ir::Rung& b) {
  return a.ops == b.ops && a.args == b.args && a.transfer == b.transfer;
}

ir::Module changed(const Compiled& source, std::span<const rung_forced_byte> forced) {
  ir::Module module = *source.built;
  ir::forceBits(module, forced);
  ir::runPasses(module, source.passes);
  return module;
}

} // namespace

ForcedProgram::ForcedProgram(const Compiled& source, std::span<const rung_forced_byte> forced)
    : module(changed(source, forced)), layout(source.layout->over(module)) {}

std::vector<uint32_t> ForcedProgram::changedChunks(const ir::Module& other) const {
  std::vector<uint32_t> distinct;
  for (uint32_t i = 0; i < layout.partition().chunks().size(); ++i) {
    const ir::Chunk& chunk = layout.partition().chunks()[i];
    const auto here = module.at(chunk.routine).rungs.begin() + chunk.firstRung;
    const auto there = other.at(chunk.routine).rungs.begin() + chunk.firstRung;
    if (!std::equal(here, here + chunk.rungCount, there, sameCode)) distinct.push_back(i);
  }
  return distinct;
}

} // namespace rung::compiler
