// Goldens of the IR. passes/*.rir: a pass on a module, and what that becomes. text/*.rir: canonical texts, which print
// as they are. verify/*.rir: modules with errors; after the module, as comments that begin with `;! `, the errors as
// they are rendered.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <vector>

#include "ir/text/text.h"
#include "ir/transforms/passes.h"
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

// Of a file that begins with `; passes: NAME,…`: those passes, in this order.
std::vector<const Pass*> passesOf(std::string_view text) {
  constexpr std::string_view kBegin = "; passes: ";
  EXPECT_TRUE(text.starts_with(kBegin));
  std::string names(text.substr(kBegin.size(), text.find('\n') - kBegin.size()));
  std::ranges::replace(names, ',', ' ');
  std::istringstream words(names);
  std::vector<const Pass*> passes;
  for (std::string name; words >> name;) passes.push_back(findPass(name));
  return passes;
}

TEST(GoldenPasses, GiveWhatTheyGave) {
  Golden golden("tests/golden/ir/passes", {".rir"});
  std::set<const Pass*> seen;
  for (const fs::path& file : golden.inputs()) {
    SCOPED_TRACE(file);
    Module module = moduleIn(golden, file);
    ASSERT_EQ(render(module, verify(module, Mode::Built)), "");
    PassRunner runner(module);
    for (const Pass* pass : passesOf(golden.read(file))) {
      ASSERT_NE(pass, nullptr);
      runner.run(*pass);
      seen.insert(pass);
    }
    ASSERT_EQ(render(module, verify(module, module.instrumented ? Mode::Final : Mode::Built)), "");
    golden.expect(file, ".after", print(module));
  }
  for (const Pass& pass : allPasses()) EXPECT_TRUE(seen.contains(&pass)) << pass.name << " has no golden";
}

} // namespace
} // namespace rung::ir
