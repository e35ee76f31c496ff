// From an example's sources to its shared object (see examples.h).
#include "tests/threads/examples.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "codegen/cpp/cpp_emitter.h"
#include "frontend/dialects/dialect.h"
#include "ir/passes/pipeline.h"
#include "ir/support/diag_render.h"
#include "ir/support/temporary_folder.h"
#include "rtlib/host/sealing.h"

namespace rung::test {

namespace {

const frontend::Dialect* dialectOf(const Example& example) {
  for (const frontend::Dialect* dialect : frontend::allDialects())
    if (example.name.starts_with(std::string(dialect->name) + "-")) return dialect;
  return nullptr;
}

std::string compile(const Example& example) {
  SourceManager sources;
  Diagnostics diagnostics;
  std::vector<FileId> files;
  for (const std::string& name : example.files) {
    const Result<FileId> file = sources.addFile("examples/" + example.name + "/" + name);
    EXPECT_TRUE(file.ok()) << name << ": run in the root of the repository";
    if (file.ok()) files.push_back(file.value());
  }
  const std::unique_ptr<ir::Module> module = dialectOf(example)->compile(sources, files, {}, diagnostics);
  EXPECT_NE(module, nullptr) << renderText(diagnostics, sources);
  if (module == nullptr) return {};
  ir::runPasses(*module, {});
  return codegen::emitCpp(ir::Layout(*module, {}), 1, {});
}

} // namespace

std::unique_ptr<host::SoEngine> load(const Example& example) {
  const Result<std::string> object =
      codegen::buildCppSharedObject(compile(example), {.compiler = RUNG_TEST_CXX, .optimisation = "-O1"});
  EXPECT_TRUE(object.ok()) << object.error();
  if (!object.ok()) return nullptr;
  const TemporaryFolder folder;
  const std::string path = (folder / "program.so").string();
  std::string error = host::replaceFile(path, host::sealed(object.value()), {.mode = host::kProgramMode});
  EXPECT_EQ(error, "");
  std::unique_ptr<host::SoEngine> engine = host::SoEngine::open(path, error);
  EXPECT_NE(engine, nullptr) << error;
  return engine;
}

} // namespace rung::test
