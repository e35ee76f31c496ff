// Programs beside what they become: NAME.lad with NAME.ir (the module's text) or NAME.diag (the diagnostics).
#include <gtest/gtest.h>

#include "frontend/dialects/nct/nct.h"
#include "ir/support/diag_render.h"
#include "ir/text/text.h"
#include "ir/transforms/passes.h"
#include "tests/support/golden.h"

namespace rung::frontend::nct {
namespace {

TEST(NctGolden, AllPrograms) {
  test::Golden golden("tests/golden/nct", {".lad"});
  for (const std::filesystem::path& program : golden.inputs()) {
    SourceManager sources;
    Diagnostics diagnostics;
    // The text is named as a user would name it, whatever the folder of the repository.
    const FileId file = sources.addBuffer(program.filename(), golden.read(program));
    const std::unique_ptr<ir::Module> module = kNct.compile(sources, {&file, 1}, {}, diagnostics);
    if (!module) {
      golden.expect(program, ".diag", renderText(diagnostics, sources));
      continue;
    }
    ir::orderOperations(*module);
    const std::string text = ir::print(*module);
    golden.expect(program, ".ir", text);
    const ir::ParseOutcome again = ir::parse(text);
    ASSERT_TRUE(again.module) << again.error.line << ": " << again.error.message;
    EXPECT_EQ(ir::print(*again.module), text);
  }
}

} // namespace
} // namespace rung::frontend::nct
