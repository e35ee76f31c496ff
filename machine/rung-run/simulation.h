// Loads the plug-in with the simulated controls.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "machine/rung-run/simulation_plugin.h"

namespace rung::rung_run {

// For a program of the dialect; `config` is KEY=VALUE each. Throws std::runtime_error where there is no such plug-in,
// or a key or its value is wrong. The plug-in stays loaded.
std::unique_ptr<Simulation> loadSimulation(const char* dialect, const std::vector<std::string>& config);

} // namespace rung::rung_run
