// From sources to a shared object (see cpp_program.h).
#include "tests/support/cpp_program.h"

#include "codegen/cpp/cpp_emitter.h"
#include "ir/support/diag_render.h"
#include "ir/transforms/pipeline.h"

namespace rung::test {

Result<std::string> buildCppProgram(const frontend::Dialect& dialect, SourceManager& sources,
                                    std::span<const FileId> files, const frontend::CompileOptions& options) {
  Diagnostics diagnostics;
  const std::unique_ptr<ir::Module> module = dialect.compile(sources, files, options, diagnostics);
  if (module == nullptr) return failure(renderText(diagnostics, sources));
  ir::runPasses(*module, {});
  return codegen::buildCppSharedObject(codegen::emitCpp(ir::Layout(*module, {}), 1, {}),
                                       {.compiler = RUNG_TEST_CXX, .optimisation = RUNG_TEST_OPTIMISATION});
}

} // namespace rung::test
