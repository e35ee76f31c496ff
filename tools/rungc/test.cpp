// rungc test: scenarios on one or several engines.
#include <fmt/format.h>
#include <fstream>

#include "tools/rungc/commands.h"
#include "tools/rungc/junit.h"
#include "tools/rungc/scenarios.h"

namespace rung::rungc {
namespace {

struct TestOptions {
  std::vector<std::string> files;
  std::string engines = "jit";
  std::string junit;
  std::string cxx;
  bool strict = false;
  std::string level = "2";
};

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

} // namespace rung::rungc
