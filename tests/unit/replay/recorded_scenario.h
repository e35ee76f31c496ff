// A scenario of the repository, run on the interpreter and recorded.
#pragma once
#include <stdexcept>
#include <string>
#include <utility>

#include "tools/replay/record_run.h"
#include "tools/scenario/in_project.h"

namespace rung::replay {

// The file belongs to its project. Throws std::runtime_error, which fails the test, if it cannot be recorded.
inline RecordedScenario recordedScenario(const std::string& file) {
  Result<scenario::Scenario> scenario = scenario::readScenario(file);
  if (!scenario.ok()) throw std::runtime_error(scenario.error());
  scenario::takeProject(scenario.value());
  Result<RecordedScenario> recorded = recordScenario(scenario.value(), {.engines = {compiler::EngineKind::Interp}});
  if (!recorded.ok()) throw std::runtime_error(file + ": " + recorded.error());
  return std::move(recorded).value();
}

} // namespace rung::replay
