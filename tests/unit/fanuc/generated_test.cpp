// Generated programs: they compile, and to the same when they are laid out.
#include <gtest/gtest.h>

#include "frontend/dialects/fanuc/fanuc.h"
#include "ir/support/diag_render.h"
#include "ir/verify/verify.h"
#include "tests/support/formatting.h"
#include "tests/support/long_run.h"
#include "tests/unit/fanuc/program_generator.h"

namespace rung::frontend::fanuc::test {
namespace {

const uint64_t kPrograms = rung::testing::howMany(200, 2000);

TEST(FanucGenerated, ProgramsCompile) {
  for (uint64_t seed = 0; seed < kPrograms && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    const std::string list = ProgramGenerator(seed).list();
    SourceManager sources;
    Diagnostics diagnostics;
    const FileId file = sources.addBuffer("test.mne", list);
    const auto module = kFanuc.compile(sources, {&file, 1}, {}, diagnostics);
    ASSERT_TRUE(module) << renderText(diagnostics, sources) << list;
    EXPECT_TRUE(ir::verify(*module, ir::Mode::Built).empty());
  }
}

TEST(FanucGenerated, ProgramsAreTheSameLaidOut) {
  for (uint64_t seed = 0; seed < kPrograms && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    const std::string list = ProgramGenerator(seed).list();
    SourceManager sources, laidOut;
    Diagnostics diagnostics;
    const FileId file = sources.addBuffer("test.mne", list);
    const auto formatted = kFanuc.format(sources, file, diagnostics);
    ASSERT_TRUE(formatted) << list;
    const auto lines = rung::test::onItsLines(*formatted, list);
    ASSERT_TRUE(lines) << list << "=====\n" << *formatted;
    const FileId again = laidOut.addBuffer("test.mne", *lines);
    const auto meaning = rung::test::meaningOf(kFanuc, sources, {&file, 1}, {});
    const auto other = rung::test::meaningOf(kFanuc, laidOut, {&again, 1}, {});
    EXPECT_TRUE(meaning == other) << rung::test::differenceOf(meaning, other);
  }
}

} // namespace
} // namespace rung::frontend::fanuc::test
