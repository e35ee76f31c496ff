// The interface of the plug-in with the simulated controls for rung-run, which loads it on request. Both must be of one
// build, which is checked, because C++ objects pass between them.
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
  // Once: creates the program within the simulated control, which owns it.
  virtual Instance instance(const Image& image, const rung_instance_options& options) = 0;

  // ---- after its power-on

  // What in the control's own files does not fit the program, and is ignored.
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

// The build text: it differs if the sources of the runtime, of which both have a copy, or of this interface differ.
std::string_view simulationVersion();
// Of the file that includes this.
inline std::string simulationBuild() { return std::string(__VERSION__) + " " + std::string(simulationVersion()); }

} // namespace rung::rung_run
