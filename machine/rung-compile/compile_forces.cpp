// See compile_forces.h. The file comes from a program that the host runs, but is not trusted either.
#include "machine/rung-compile/compile_forces.h"

#include <algorithm>
#include <optional>

#include "codegen/llvm/llvm_emitter.h"
#include "compiler/embedded_ir.h"
#include "compiler/recompiler.h"
#include "ir/verify/verify.h"
#include "machine/compile/forced_code_maker.h"
#include "rtlib/load/seal.h"

namespace rung::rung_compile {
namespace {

bool liesIn(const ir::Module& module, const rung_forced_byte& forced) {
  if (forced.space >= module.spaces.size()) return false;
  const ir::Space& space = module.spaces[forced.space];
  return forced.byte < uint64_t{space.unitBytes} * space.units;
}

Outcome compile(const compile::Forces& forces) {
  const Result<compiler::Compiled> compiled =
      compiler::irOf(runtime::readSealed(forces.program).image, {.code = forces.codeHash, .layout = forces.layoutHash});
  if (!compiled.ok()) return failed(compiled.error());
  const compiler::Compiled& running = compiled.value();
  if (!std::ranges::all_of(forces.bytes, [&](const auto& byte) { return liesIn(*running.built, byte); }))
    return failed("found a forced byte that lies in no space of the program");
  const compiler::ForcedProgram forced(running, forces.bytes);
  if (!ir::verify(forced.module, ir::Mode::Final).empty())
    return failed("the program with forced variables is not valid");
  codegen::LlvmOptions options;
  options.debugInfo = false;
  const Result<std::string> object = codegen::buildLlvmSharedObjectByOutput(forced.layout, running.codeHash, options);
  if (!object.ok()) return failed(object.error());
  return {.verdict = compile::kVerdictCompiled, .report = {}, .image = runtime::sealed(object.value())};
}

} // namespace

Outcome compileForces(std::string_view packed) {
  return outcomeOf([&] {
    std::string problem;
    const std::optional<compile::Forces> given = compile::unpackedForces(packed, problem);
    return given ? compile(*given) : failed(std::move(problem));
  });
}

} // namespace rung::rung_compile
