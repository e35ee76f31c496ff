// Sources beside what they are laid out as: NAME.EXTENSION with NAME.EXTENSION.out, or NAME.EXTENSION.diag where they
// cannot be read.
#include <gtest/gtest.h>

#include "frontend/dialects/dialect.h"
#include "ir/support/diag_render.h"
#include "tests/support/golden.h"

namespace rung {
namespace {

TEST(FormatGolden, AllSources) {
  test::Golden golden("tests/golden/format", {".lad", ".mne", ".pmc", ".plc"});
  for (const std::filesystem::path& input : golden.inputs()) {
    SCOPED_TRACE(input);
    SourceManager sources;
    Diagnostics diagnostics;
    const std::string name = input.filename();
    const FileId file = sources.addBuffer(name, golden.read(input));
    const frontend::Dialect* dialect = frontend::dialectOf(sources, file);
    ASSERT_NE(dialect, nullptr);
    const auto text = dialect->format(sources, file, diagnostics);
    if (!text) {
      golden.expect(name + ".diag", renderText(diagnostics, sources));
      continue;
    }
    golden.expect(name + ".out", *text);
    EXPECT_EQ(dialect->format(sources, sources.addBuffer(name, *text), diagnostics), text);
  }
}

} // namespace
} // namespace rung
