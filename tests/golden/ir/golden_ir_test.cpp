// Goldens of the IR. text/*.rir: canonical texts, which print as they are. verify/*.rir: modules with errors; after the
// module, as comments that begin with `;! `, the errors as they are rendered.
#include <gtest/gtest.h>

#include <sstream>

#include "ir/text/text.h"
#include "ir/verify/verify.h"
#include "tests/support/golden.h"

namespace rung::ir {
namespace {

namespace fs = std::filesystem;
using test::Golden;

constexpr std::string_view kMark = ";! ";

Module moduleIn(const Golden& golden, const fs::path& file) {
  ParseOutcome parsed = parse(golden.read(file));
  EXPECT_TRUE(parsed.module) << file << ':' << parsed.error.line << ':' << parsed.error.column << ": "
                             << parsed.error.message;
  return parsed.module ? std::move(*parsed.module) : Module{};
}

TEST(GoldenText, PrintsAsItIs) {
  Golden golden("tests/golden/ir/text", {".rir"});
  for (const fs::path& file : golden.inputs()) {
    const Module module = moduleIn(golden, file);
    const std::vector<VerifyError> errors = verify(module, Mode::Final);
    EXPECT_TRUE(errors.empty()) << file << '\n' << render(module, errors);
    golden.expect(file.filename(), print(module));
  }
}

TEST(GoldenVerify, RendersItsErrors) {
  Golden golden("tests/golden/ir/verify", {".rir"});
  for (const fs::path& file : golden.inputs()) {
    const Module module = moduleIn(golden, file);
    const std::vector<VerifyError> errors = verify(module, Mode::Final);
    EXPECT_FALSE(errors.empty()) << file;
    const std::string text = golden.read(file);
    const size_t mark = text.find("\n" + std::string(kMark));
    std::string actual = text.substr(0, mark == std::string::npos ? mark : mark + 1);
    std::istringstream lines(render(module, errors));
    for (std::string line; std::getline(lines, line);) actual += std::string(kMark) + line + '\n';
    golden.expect(file.filename(), actual);
  }
}

} // namespace
} // namespace rung::ir
