// What the commands that run scenarios share (see scenarios.h).
#include "tools/rungc/scenarios.h"

#include <chrono>
#include <fmt/format.h>
#include <sstream>

namespace rung::rungc {

Result<std::vector<compiler::EngineKind>> enginesOf(const std::string& names) {
  std::vector<compiler::EngineKind> engines;
  std::istringstream in(names);
  for (std::string name; std::getline(in, name, ',');) {
    if (name == "all") {
      engines.assign(compiler::allEngines().begin(), compiler::allEngines().end());
      continue;
    }
    const auto kind = compiler::engineFromName(name);
    if (!kind)
      return failure(fmt::format("unknown engine '{}'; the engines are interp, cpp, llvm, jit, tiered and all", name));
    engines.push_back(*kind);
  }
  return engines;
}

TestCase runOne(const std::string& path, const scenario::RunOptions& options) {
  TestCase test{path, 0, {}};
  const auto start = std::chrono::steady_clock::now();
  Result<scenario::Scenario> parsed = scenario::readScenario(path);
  if (!parsed.ok())
    test.result.environment = parsed.error();
  else
    test.result = scenario::run(parsed.value(), options);
  test.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return test;
}

std::string shownSeconds(double seconds) {
  return seconds < 1 ? fmt::format("{:.0f} ms", seconds * 1000) : fmt::format("{:.2f} s", seconds);
}

void printResult(const TestCase& test, bool color) {
  const scenario::RunResult& result = test.result;
  const auto painted = [&](const char* word, const char* paint) {
    return color ? fmt::format("\033[{}m{}\033[0m", paint, word) : std::string(word);
  };
  if (result.passed)
    fmt::print("{}      {} ({} scans, {})\n", painted("ok", "32"), test.path, result.scans, shownSeconds(test.seconds));
  else
    fmt::print("{}  {}\n", painted("FAILED", "1;31"), test.path);
  for (const std::string& line : result.printed) fmt::print("  {}\n", line);
  for (const scenario::Problem& problem : result.problems) fmt::print("  {}\n", textOf(problem));
  if (!result.environment.empty()) fmt::print("  {}\n", result.environment);
  if (result.passed && result.expectsNothing)
    fmt::print("  {}: {}: it expects nothing, so it passes whatever the program does; add an expect statement\n",
               test.path, painted("warning", "1;35"));
}

} // namespace rung::rungc
