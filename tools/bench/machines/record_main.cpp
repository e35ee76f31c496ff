// rung-bench-record SCENARIO: runs the scenario on the interpreter and prints what its machine writes (recording.h).
#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "tools/bench/machines/recorder.h"
#include "tools/scenario/runner.h"

namespace {

using namespace rung;

std::string recordingOf(const std::string& path) {
  const Result<scenario::Scenario> scenario = scenario::readScenario(path);
  if (!scenario.ok()) throw std::runtime_error(scenario.error());
  bench::Recording recording;
  std::unique_ptr<bench::Recorder> recorder;
  scenario::RunOptions options;
  options.engines = {compiler::EngineKind::Interp};
  options.started = [&](scenario::Session& session, const compiler::Compiled& program) {
    recorder =
        std::make_unique<bench::Recorder>(session, program, compiler::EngineKind::Interp, [&](bench::Part&& part) {
          part.hash = recorder->replay().hash();
          recording.parts.push_back(std::move(part));
        });
    return std::string();
  };
  const scenario::RunResult result = scenario::run(scenario.value(), options);
  if (!result.environment.empty()) throw std::runtime_error(result.environment);
  if (!result.passed) throw std::runtime_error("the scenario fails: rungc test says why");
  if (!recorder->problem().empty()) throw std::runtime_error(recorder->problem());
  return bench::textOf(recording);
}

} // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "usage: rung-bench-record SCENARIO\n";
    return 2;
  }
  std::cout << recordingOf(argv[1]);
  return 0;
} catch (const std::exception& problem) {
  std::cerr << "rung-bench-record: " << problem.what() << '\n';
  return 1;
}
