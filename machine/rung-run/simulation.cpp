// See simulation.h.
#include "machine/rung-run/simulation.h"

#include <stdexcept>

#include "machine/rung-run/config_pairs.h"
#include "rtlib/load/plugin.h"

namespace rung::rung_run {
namespace {

MakeSimulation load() {
  static const runtime::Plugin plugin(kSimulationPlugin, simulationBuild());
  if (!plugin.ok()) throw std::runtime_error("cannot simulate the control: " + plugin.problem());
  return plugin.function<MakeSimulation>(kMakeSimulation);
}

} // namespace

std::unique_ptr<Simulation> loadSimulation(const char* dialect, const std::vector<std::string>& config) {
  std::unique_ptr<Simulation> simulation(load()(dialect));
  forPairs(config, [&](const std::string& key, const std::string& value) { return simulation->config(key, value); });
  return simulation;
}

} // namespace rung::rung_run
