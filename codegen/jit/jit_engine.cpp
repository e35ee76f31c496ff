// See jit_engine.h.
#include "codegen/jit/jit_engine.h"

#include <numeric>
#include <vector>

#include "ir/image/program_image.h"

namespace rung::codegen {

using namespace ir;

struct JitEngine::State {
  State(const Layout& layout, uint64_t codeHash)
      : image(layout, codeHash), functions(layout.partition().chunks().size()) {}

  ProgramImage image;
  std::unique_ptr<JitCode> code;
  std::vector<rung_chunk_fn> functions; // by chunk
};

JitEngine::JitEngine(std::unique_ptr<State> state) : state_(std::move(state)) {}
JitEngine::~JitEngine() = default;
const rung_program& JitEngine::program() const { return state_->image.program(); }
const JitReport& JitEngine::report() const { return state_->code->report(); }

Result<std::unique_ptr<JitEngine>> compileJit(const Layout& layout, uint64_t codeHash, const JitOptions& options) {
  Result<std::unique_ptr<JitCode>> code = makeJitCode(options);
  if (!code.ok()) return code.failure();
  auto state = std::make_unique<JitEngine::State>(layout, codeHash);
  state->code = std::move(code).value();
  std::vector<uint32_t> all(layout.partition().chunks().size());
  std::iota(all.begin(), all.end(), 0);
  const auto take = [&](uint32_t chunk, rung_chunk_fn function) { state->functions[chunk] = function; };
  const Result<void> compiled = state->code->compile(layout, codeHash, all, take, nullptr);
  if (!compiled.ok()) return compiled.failure();
  state->image.program().chunk_fns = state->functions.data();
  return std::unique_ptr<JitEngine>(new JitEngine(std::move(state)));
}

} // namespace rung::codegen
