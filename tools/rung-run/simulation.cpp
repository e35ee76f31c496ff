// See simulation.h.
#include "tools/rung-run/simulation.h"

#include <dlfcn.h>
#include <unistd.h>

#include <climits>
#include <stdexcept>

#include "tools/rung-run/config_pairs.h"

namespace rung::rung_run {
namespace {

// Of this program's folder: BIN/../lib/rung, in a build and where it is installed.
std::string pluginPath() {
  char self[PATH_MAX];
  const ssize_t size = readlink("/proc/self/exe", self, sizeof self);
  if (size <= 0) throw std::runtime_error("cannot find the folder of rung-run");
  const std::string program(self, static_cast<size_t>(size));
  return program.substr(0, program.rfind('/')) + "/../lib/rung/rung-simulation.so";
}

template <class Function>
Function symbolOf(void* plugin, const char* name) {
  return reinterpret_cast<Function>(dlsym(plugin, name));
}

MakeSimulation load(const std::string& path) {
  void* plugin = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (plugin == nullptr) throw std::runtime_error(std::string("no control can be simulated: ") + dlerror());
  const auto build = symbolOf<SimulationBuild>(plugin, kSimulationBuild);
  const auto make = symbolOf<MakeSimulation>(plugin, kMakeSimulation);
  if (build == nullptr || make == nullptr || build() != simulationBuild())
    throw std::runtime_error(path + ": it is of another build than this rung-run; install both together");
  return make;
}

} // namespace

std::unique_ptr<Simulation> loadSimulation(const char* dialect, const std::vector<std::string>& config) {
  std::unique_ptr<Simulation> simulation(load(pluginPath())(dialect));
  forPairs(config, [&](const std::string& key, const std::string& value) { return simulation->config(key, value); });
  return simulation;
}

} // namespace rung::rung_run
