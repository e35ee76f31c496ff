// See configuration.h.
#include "tools/scenario/configuration.h"

#include "sim/simulated_nc.h"

namespace rung::scenario {

std::vector<compiler::ConfigProblem> checkConfiguration(const frontend::Dialect& dialect,
                                                        compiler::ConfigPairs config) {
  std::vector<compiler::ConfigProblem> problems;
  const std::unique_ptr<sim::SimulatedNc> model = sim::makeSimulatedNc(dialect.name);
  for (const auto& [key, value] : config) {
    if (auto problem = compiler::checkSetting(dialect, key, value)) {
      problems.push_back(std::move(*problem));
      continue;
    }
    if (nc::findConfigKey(dialect.configKeys, key)->reader != nc::ConfigReader::Control) continue;
    if (std::string text = model->config(key, value); !text.empty()) problems.push_back({key, std::move(text)});
  }
  return problems;
}

} // namespace rung::scenario
