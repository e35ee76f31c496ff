// rung-bench-services PROGRAM.so SCENARIO COUNT: plays the scenario with the program, then runs COUNT more scans. Under
// callgrind, started with --collect-atstart=no, only these are counted. The program is that of the scenario, compiled
// before.
#include <valgrind/callgrind.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "rtlib/load/so_engine.h"
#include "tools/scenario/session.h"
#include "tools/scenario/statements.h"

namespace {

using namespace rung;

void check(const std::string& problem) {
  if (!problem.empty()) throw std::runtime_error(problem);
}

std::unique_ptr<runtime::SoEngine> load(const std::string& program) {
  std::string error;
  auto engine = runtime::SoEngine::open(program, error);
  check(error);
  return engine;
}

void play(scenario::Session& session, const scenario::Scenario& scenario) {
  for (const scenario::Problem& problem : scenario.problems) check(textOf(problem));
  for (const scenario::Statement& s : scenario.statements)
    if (s.kind == scenario::Kind::Config) check(session.config(s.name, s.value.text));
  for (const sim::NcProblem& problem : session.start()) check(problem.text);
  for (const scenario::Statement& s : scenario.statements) {
    if (scenario::StatementInfo::of(s).stage != scenario::Stage::Run) continue;
    if (const auto problem = session.execute(s)) check(textOf(*problem));
  }
}

void count(const std::string& program, const std::string& path, unsigned long scans) {
  const auto engine = load(program);
  const Result<scenario::Scenario> scenario = scenario::readScenario(path);
  if (!scenario.ok()) throw std::runtime_error(scenario.error());
  scenario::Session session("");
  session.addEngine(*engine);
  play(session, scenario.value());
  CALLGRIND_TOGGLE_COLLECT;
  for (unsigned long i = 0; i < scans; ++i) session.machine().scan();
  CALLGRIND_TOGGLE_COLLECT;
  check(session.unexpectedFault());
}

} // namespace

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::cerr << "usage: rung-bench-services PROGRAM.so SCENARIO COUNT\n";
    return 2;
  }
  count(argv[1], argv[2], std::strtoul(argv[3], nullptr, 10));
  return 0;
} catch (const std::exception& problem) {
  std::cerr << "rung-bench-services: " << problem.what() << '\n';
  return 1;
}
