// Programs beside what they become: NAME.pmc or NAME.lad with NAME.ir (the module's text) or NAME.diag (what the
// compiler says).
#include <gtest/gtest.h>

#include "ir/text/text.h"
#include "ir/transforms/passes.h"
#include "tests/support/golden.h"
#include "tests/unit/gsk/compile.h"

namespace rung::frontend::gsk::test {
namespace {

TEST(GskGolden, AllPrograms) {
  rung::test::Golden golden("tests/golden/gsk", {".pmc", ".lad"});
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
} // namespace rung::frontend::gsk::test
