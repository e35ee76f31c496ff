// The prompt of `rungc replay` on scenarios of the examples, in all dialects: tests/golden/replay has the scenario and
// the commands, and what is said.
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sstream>

#include "tests/support/golden.h"
#include "tests/unit/replay/recorded_scenario.h"
#include "tools/replay/console.h"

namespace rung::replay {
namespace {

// What the prompt prints for these lines.
std::string said(const std::string& file, const std::vector<std::string>& lines) {
  const RecordedScenario recorded = recordedScenario(file);
  Result<std::unique_ptr<Past>> past = Past::open(recorded.recording, {.engine = compiler::EngineKind::Interp});
  EXPECT_TRUE(past.ok());
  EXPECT_EQ(past.value()->goTo(past.value()->contents().parts), "");
  std::string text;
  Console console(*past.value(), [&](const std::string& line) { text += line + "\n"; });
  for (const std::string& line : lines) {
    text += fmt::format("{}{}\n", console.prompt(), line);
    (void)console.execute(line);
  }
  return text;
}

TEST(ReplayGolden, SaysWhatWasRecorded) {
  test::Golden golden("tests/golden/replay", {".replay"});
  for (const std::filesystem::path& input : golden.inputs()) {
    std::istringstream lines(golden.read(input));
    std::string scenario;
    std::getline(lines, scenario);
    std::vector<std::string> commands;
    for (std::string line; std::getline(lines, line);) commands.push_back(line);
    golden.expect(input, ".txt", said(scenario, commands));
  }
}

} // namespace
} // namespace rung::replay
