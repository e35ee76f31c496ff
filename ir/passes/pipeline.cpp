// The order of the passes (see pipeline.h).
#include "ir/passes/pipeline.h"

#include "ir/passes/passes.h"
#include "ir/support/check.h"
#include "ir/verify/verify.h"

namespace rung::ir {
namespace {

class Pipeline {
public:
  Pipeline(Module& module, bool verifyEach) : module_(module), verifyEach_(verifyEach) {}

  void run(void (*pass)(Module&)) {
    pass(module_);
    check();
  }
  void run(void (*pass)(Module&, Settled&), Settled& settled) {
    pass(module_, settled);
    check();
  }

private:
  void check() const {
    if (!verifyEach_) return;
    const std::vector<VerifyError> errors = verify(module_, module_.instrumented ? Mode::Final : Mode::Built);
    const std::string text = errors.empty() ? std::string() : render(module_, errors);
    RUNG_CHECK(errors.empty(), text.c_str());
  }

  Module& module_;
  bool verifyEach_;
};

} // namespace

void runPasses(Module& module, const PassOptions& options, Module* shape) {
  Pipeline pipeline(module, options.verifyEach);
  if (options.optimise) pipeline.run(inlineRoutines);
  pipeline.run(keepCarried);
  if (shape != nullptr) *shape = module;
  if (options.optimise) {
    Settled settled(module);
    pipeline.run(foldConstants, settled);
    pipeline.run(reuseValues, settled);
    pipeline.run(foldConstants, settled); // of values that now are known to have been stored
    pipeline.run(removeDeadOps, settled); // loads, that else would keep stores to registers
    pipeline.run(removeTransientStores, settled);
    pipeline.run(removeDeadOps, settled);
    pipeline.run(guardIndices, settled);
    pipeline.run(foldConstants, settled);
    pipeline.run(reuseValues, settled);
    pipeline.run(foldConstants, settled);
    pipeline.run(removeDeadOps, settled);
  }
  if (options.instrument) pipeline.run(instrumentRungs);
}

} // namespace rung::ir
