// The order of the passes (see pipeline.h).
#include "ir/transforms/pipeline.h"

#include <vector>

#include "ir/support/check.h"
#include "ir/transforms/passes.h"
#include "ir/verify/verify.h"

namespace rung::ir {
namespace {

constexpr std::string_view kOptimising[] = {
    // These determine the shape.
    "inline", "carried",
    // The first fold is repeated, with values that reuse has found to be stored; removing dead loads before dead stores
    // to registers leaves fewer readers of those.
    "fold", "reuse", "fold", "dead", "transient", "dead",
    // Versions are new rungs.
    "versions", "fold", "reuse", "fold", "dead"};
constexpr size_t kShapePasses = 2;

void verifyNow(const Module& module) {
  const std::vector<VerifyError> errors = verify(module, module.instrumented ? Mode::Final : Mode::Built);
  const std::string text = errors.empty() ? std::string() : render(module, errors);
  RUNG_CHECK(errors.empty(), text.c_str());
}

} // namespace

std::span<const std::string_view> optimisingPasses() { return kOptimising; }

void runPasses(Module& module, const PassOptions& options, Module* shape) {
  PassRunner runner(module,
                    options.verifyEach ? [](const Pass&, const Module& m) { verifyNow(m); } : PassRunner::Observer());
  const auto run = [&](std::span<const std::string_view> names) {
    for (const std::string_view name : names) runner.run(*findPass(name));
  };
  const std::span<const std::string_view> passes(kOptimising);
  if (options.optimise)
    run(passes.first(kShapePasses));
  else
    runner.run(*findPass("carried"));
  if (shape != nullptr) *shape = module;
  if (options.optimise) run(passes.subspan(kShapePasses));
  if (options.instrument) runner.run(*findPass("instrument"));
}

} // namespace rung::ir
