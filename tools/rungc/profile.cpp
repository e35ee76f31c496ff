// rungc profile: how often and how long every rung runs while a scenario drives the program.
#include "rtlib/profile/profile.h"

#include <fmt/format.h>
#include <iostream>

#include "tools/rungc/commands.h"
#include "tools/rungc/scenarios.h"

namespace rung::rungc {

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
