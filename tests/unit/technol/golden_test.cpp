// Programs beside what they become: NAME.plc with NAME.ir (the module's text) or NAME.diag (what the compiler says).
#include <gtest/gtest.h>

#include "ir/text/text.h"
#include "ir/transforms/passes.h"
#include "tests/support/golden.h"
#include "tests/unit/technol/program.h"

namespace rung::technol_test {
namespace {

TEST(TechnolGolden, AllPrograms) {
  rung::test::Golden golden("tests/golden/technol", {".plc"});
  for (const std::filesystem::path& program : golden.inputs()) {
    const Compilation result = compile({golden.read(program)});
    if (!result.module) {
      golden.expect(program, ".diag", result.text());
      continue;
    }
    ir::orderOperations(*result.module);
    golden.expect(program, ".ir", ir::print(*result.module));
  }
}

} // namespace
} // namespace rung::technol_test
