// From an example's sources to its shared object (see examples.h).
#include "tests/threads/examples.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "ir/support/temporary_folder.h"
#include "rtlib/load/seal.h"
#include "tests/support/cpp_program.h"

namespace rung::test {

namespace {

const frontend::Dialect* dialectOf(const Example& example) {
  for (const frontend::Dialect* dialect : frontend::allDialects())
    if (example.name.starts_with(std::string(dialect->name) + "-")) return dialect;
  return nullptr;
}

} // namespace

std::unique_ptr<runtime::SoEngine> load(const Example& example) {
  SourceManager sources;
  std::vector<FileId> files;
  for (const std::string& name : example.files) {
    const Result<FileId> file = sources.addFile("examples/" + example.name + "/" + name);
    EXPECT_TRUE(file.ok()) << name << ": run in the root of the repository";
    if (file.ok()) files.push_back(file.value());
  }
  const Result<std::string> object = buildCppProgram(*dialectOf(example), sources, files);
  if (!object.ok()) {
    ADD_FAILURE() << object.error();
    return nullptr;
  }
  const TemporaryFolder folder;
  const std::string path = (folder / "program.so").string();
  std::string error = runtime::replaceFile(path, runtime::sealed(object.value()), {.mode = runtime::kProgramMode});
  EXPECT_EQ(error, "");
  std::unique_ptr<runtime::SoEngine> engine = runtime::SoEngine::open(path, error);
  EXPECT_NE(engine, nullptr) << error;
  return engine;
}

} // namespace rung::test
