// What the commands that run scenarios share (see scenarios.h).
#include "tools/rungc/scenarios.h"

#include <chrono>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace rung::rungc {
namespace {

Result<scenario::Scenario> readScenario(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return failure(fmt::format("cannot read '{}'", path));
  std::ostringstream text;
  text << in.rdbuf();
  return scenario::parse(path, text.str());
}

} // namespace

Result<std::vector<driver::EngineKind>> enginesOf(const std::string& names) {
  std::vector<driver::EngineKind> engines;
  std::istringstream in(names);
  for (std::string name; std::getline(in, name, ',');) {
    if (name == "all") {
      engines.assign(driver::allEngines().begin(), driver::allEngines().end());
      continue;
    }
    const auto kind = driver::engineFromName(name);
    if (!kind) return failure(fmt::format("unknown engine '{}'; there are interp, cpp, llvm, jit and all", name));
    engines.push_back(*kind);
  }
  return engines;
}

TestCase runOne(const std::string& path, const scenario::RunOptions& options) {
  TestCase test{path, 0, {}};
  const auto start = std::chrono::steady_clock::now();
  Result<scenario::Scenario> parsed = readScenario(path);
  if (!parsed.ok())
    test.result.environment = parsed.error();
  else if (!parsed.value().problems.empty())
    test.result.problems = parsed.value().problems;
  else
    test.result = scenario::run(parsed.value(), options);
  test.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return test;
}

void printResult(const TestCase& test) {
  if (test.result.passed) {
    fmt::print("ok      {} ({} scans)\n", test.path, test.result.scans);
    return;
  }
  fmt::print("FAILED  {}\n", test.path);
  for (const scenario::Problem& problem : test.result.problems)
    fmt::print("  {}:{}: {}\n", test.path, problem.line, problem.message);
  if (!test.result.environment.empty()) fmt::print("  {}\n", test.result.environment);
}

} // namespace rung::rungc
