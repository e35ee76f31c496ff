// The interface of the plug-in with the simulated controls, which rung-run loads on request. Both must come from the
// same build, which is checked, because C++ objects are passed between them.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "rung/runtime.hpp"

namespace rung::rung_run {

// A simulated control around one program. Functions that return a text return "", or the error.
class Simulation {
public:
  virtual ~Simulation() = default;

  // ---- before the instance

  virtual std::string config(const std::string& key, const std::string& value) = 0;
  // Called once: creates the program within the simulated control, which owns it.
  virtual Instance instance(const Image& image, const rung_instance_options& options) = 0;

  // ---- after its power-on

  // Contents of the control's own files that do not fit the program and are ignored.
  virtual std::vector<std::string> problems() const = 0;

  // ---- scan thread, between two slices

  // Like `event NAME KEY=VALUE…` of a scenario, and a scenario's statements for a TECHNOL control: block-start
  // KEY=VALUE…, block-done, plc-start, plc-stop, plc-clear. `keys` is an object of texts and numbers. May allocate.
  virtual std::string event(const std::string& name, const nlohmann::json& keys) = 0;
};

// The function that the plug-in exports (rtlib/load/plugin.h): returns a simulation for a dialect, which the caller
// deletes.
using MakeSimulation = Simulation* (*)(const char* dialect);
inline constexpr const char* kMakeSimulation = "rung_make_simulation";
inline constexpr const char* kSimulationPlugin = "rung-simulation.so";

// The build text: it differs if the sources of the runtime, of which both have a copy, or of this interface differ.
std::string_view simulationVersion();
// The build text of the file that includes this.
inline std::string simulationBuild() { return std::string(__VERSION__) + " " + std::string(simulationVersion()); }

} // namespace rung::rung_run
