// Programs beside what they become: NAME.mne or NAME.lad with NAME.ir (the module's text) or NAME.diag (what the
// compiler says).
#include <gtest/gtest.h>

#include "ir/text/text.h"
#include "ir/transforms/passes.h"
#include "tests/support/golden.h"
#include "tests/unit/fanuc/compile.h"

namespace rung::frontend::fanuc::test {
namespace {

TEST(FanucGolden, AllPrograms) {
  rung::test::Golden golden("tests/golden/fanuc", {".mne", ".lad"});
  for (const std::filesystem::path& program : golden.inputs()) {
    const auto result = compileFiles({{program.filename(), golden.read(program)}});
    if (!result->module) {
      golden.expect(program, ".diag", result->text());
      continue;
    }
    ir::orderOperations(*result->module);
    golden.expect(program, ".ir", ir::print(*result->module));
  }
}

} // namespace
} // namespace rung::frontend::fanuc::test
