// rungc test and rungc profile: scenarios on one or several engines.
#include <chrono>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <sstream>

#include "rtlib/profile/profile.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/junit.h"
#include "tools/scenario/runner.h"

namespace rung::rungc {
namespace {

Result<scenario::Scenario> readScenario(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return failure(fmt::format("cannot read '{}'", path));
  std::ostringstream text;
  text << in.rdbuf();
  return scenario::parse(path, text.str());
}

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

struct TestOptions {
  std::vector<std::string> files;
  std::string engines = "jit";
  std::string junit;
  std::string cxx;
  bool strict = false;
  std::string level = "2";
};

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

int runTests(const TestOptions& options) {
  Result<std::vector<driver::EngineKind>> engines = enginesOf(options.engines);
  if (!engines.ok()) {
    fmt::print(stderr, "rungc: {}\n", engines.error());
    return kUsage;
  }
  scenario::EngineStore store;
  scenario::RunOptions run;
  run.store = &store;
  run.engines = engines.value();
  run.strict = options.strict;
  run.engine.cppCompiler = options.cxx;
  run.engine.optimise = options.level != "0";
  int status = kOk;
  size_t passed = 0;
  std::vector<TestCase> tests;
  for (const std::string& path : options.files) {
    tests.push_back(runOne(path, run));
    printResult(tests.back());
    passed += tests.back().result.passed ? 1 : 0;
    if (!tests.back().result.passed)
      status = std::max(status, tests.back().result.environment.empty() ? int{kWrong} : int{kEnvironment});
  }
  fmt::print("{} passed, {} failed\n", passed, tests.size() - passed);
  if (!options.junit.empty()) {
    std::ofstream out(options.junit);
    out << junitXml(tests);
    if (!out) return environmentError(fmt::format("cannot write '{}'", options.junit));
  }
  return status;
}

} // namespace

void addTest(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("test", "Run scenarios; several engines are compared after every scan");
  auto options = std::make_shared<TestOptions>();
  command->add_option("SCENARIO", options->files, "Scenario files (.scn)")->required();
  command->add_option("--engine", options->engines, "interp, cpp, llvm, jit, a list of them with commas, or all")
      ->capture_default_str();
  command->add_option("--junit", options->junit, "Write the results as JUnit XML");
  command->add_option("--cxx", options->cxx, "C++ compiler of the engine cpp");
  addLevelOption(*command, options->level);
  command->add_flag("--strict", options->strict, "Warnings that the control's own rules call errors are errors");
  command->callback([options, &status] { status = runTests(*options); });
}

void addProfile(CLI::App& app, int& status) {
  struct Options {
    std::vector<std::string> files;
    std::string scenario;
    std::string engine = "jit";
    uint32_t top = 0;
    bool json = false;
  };
  CLI::App* command = app.add_subcommand("profile", "Time every rung while a scenario runs");
  auto options = std::make_shared<Options>();
  command->add_option("FILE", options->files, "The program, instead of the one that the scenario names");
  command->add_option("--scenario", options->scenario, "Scenario that drives it")->required();
  command->add_option("--engine", options->engine, "interp, cpp, llvm or jit")->capture_default_str();
  command->add_option("--top", options->top, "Only the first N rungs");
  command->add_flag("--json", options->json, "As JSON");
  command->callback([options, &status] {
    Result<std::vector<driver::EngineKind>> engines = enginesOf(options->engine);
    if (!engines.ok() || engines.value().size() != 1) {
      fmt::print(stderr, "rungc: --engine takes one of interp, cpp, llvm and jit\n");
      status = kUsage;
      return;
    }
    scenario::RunOptions run;
    run.engines = engines.value();
    run.instrument = true;
    run.programs = options->files;
    const TestCase test = runOne(options->scenario, run);
    if (!test.result.passed) {
      printResult(test);
      status = test.result.environment.empty() ? kWrong : kEnvironment;
      return;
    }
    std::cout << (options->json ? profile::reportJson(test.result.profile)
                                : profile::reportText(test.result.profile, options->top));
    if (options->json) std::cout << '\n';
  });
}

} // namespace rung::rungc
