// Loads the plug-in with the simulated controls.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "machine/rung-run/simulation_plugin.h"

namespace rung::rung_run {

// Creates a simulation for a program of the dialect; `config` is a list of KEY=VALUE. Throws std::runtime_error if the
// plug-in is missing, or a key or its value is wrong. The plug-in stays loaded.
std::unique_ptr<Simulation> loadSimulation(const char* dialect, const std::vector<std::string>& config);

} // namespace rung::rung_run
