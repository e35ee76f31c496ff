// What the plug-in with the simulated controls offers rung-run, which loads it where that is asked for. Both are of one
// build, which is checked: what goes between them is C++.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "rung/runtime.hpp"

namespace rung::rung_run {

// A control that is simulated around one program. Texts say what is wrong; "" is nothing.
class Simulation {
public:
  virtual ~Simulation() = default;

  // ---- before the instance

  virtual std::string config(const std::string& key, const std::string& value) = 0;
  // Once: the program within the simulated control, which it owns.
  virtual Instance instance(const Image& image, const rung_instance_options& options) = 0;

  // ---- after its power-on

  // What in the control's own files does not fit the program, and is not served.
  virtual std::vector<std::string> problems() const = 0;

  // ---- the thread that scans, between two slices

  // As `event NAME KEY=VALUE…` of a scenario, and its statements for a TECHNOL control: block-start KEY=VALUE…,
  // block-done, plc-start, plc-stop, plc-clear. `keys` is an object of texts and numbers. It may allocate.
  virtual std::string event(const std::string& name, const nlohmann::json& keys) = 0;
};

// What the plug-in exports (rtlib/load/plugin.h): a simulation for a dialect, which the caller deletes.
using MakeSimulation = Simulation* (*)(const char* dialect);
inline constexpr const char* kMakeSimulation = "rung_make_simulation";
inline constexpr const char* kSimulationPlugin = "rung-simulation.so";

// Another one for other sources of the runtime, of which both have a copy, and of what goes between them.
std::string_view simulationVersion();
// Of the file that includes this.
inline std::string simulationBuild() { return std::string(__VERSION__) + " " + std::string(simulationVersion()); }

} // namespace rung::rung_run
