// The plug-in of rung-run: a program in a simulated control. It contains a second copy of the runtime, which makes the
// instance and the simulation; the host runs that instance by its own copy, of the same build.
#include <algorithm>
#include <exception>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "machine/rung-run/simulation_plugin.h"
#include "rtlib/api/environment.h"
#include "rtlib/nc/config_key.h"
#include "sim/simulated_nc.h"

namespace rung::rung_run {
namespace {

sim::NcArgument argumentOf(const std::string& key, const nlohmann::json& value) {
  sim::NcArgument argument{.key = key};
  argument.isText = value.is_string();
  argument.isReal = value.is_number_float();
  if (argument.isText) argument.text = value.get<std::string>();
  if (argument.isReal) argument.real = value.get<double>();
  if (value.is_number_integer()) argument.integer = value.get<int64_t>();
  return argument;
}

using Arguments = std::vector<sim::NcArgument>;

// Statements of scenarios that are not events.
struct Statement {
  std::string_view name;
  std::string (*carryOut)(sim::SimulatedNc& nc, runtime::Instance& inside, const Arguments& keys);
};
constexpr Statement kStatements[] = {
    {"block-start", [](auto& nc, auto& inside, const Arguments& keys) { return nc.blockStart(inside, keys); }},
    {"block-done", [](auto& nc, auto& inside, const Arguments&) { return nc.blockDone(inside); }},
    {"plc-start", [](auto& nc, auto& inside, const Arguments&) { return nc.plcCommand(inside, "start"); }},
    {"plc-stop", [](auto& nc, auto& inside, const Arguments&) { return nc.plcCommand(inside, "stop"); }},
    {"plc-clear", [](auto& nc, auto& inside, const Arguments&) { return nc.plcCommand(inside, "clear"); }},
};

std::span<const nc::ConfigKey> keysOf(std::string_view dialect) {
  if (dialect == "fanuc") return nc::fanucConfigKeys();
  if (dialect == "gsk") return nc::gskConfigKeys();
  if (dialect == "nct") return nc::nctConfigKeys();
  return nc::technolConfigKeys();
}

class SimulatedControl final : public Simulation {
public:
  explicit SimulatedControl(const char* dialect)
      : keys_(keysOf(dialect)), made_(sim::makeSimulatedNc(dialect)), nc_(*made_) {
    // Selects the simulated NC for dialects that also have a scripted one; others do not have this key.
    (void)nc_.config("nc", "simulated");
    nc_.setRealTime();
  }

  std::string config(const std::string& key, const std::string& value) override {
    const nc::ConfigKey* row = nc::findConfigKey(keys_, key);
    if (row == nullptr || row->reader == nc::ConfigReader::Control) return nc_.config(key, value);
    return key + " is read by the compiler, not by the control: build the program with rungc build --config " + key +
           "=" + value + ", or run a project that has it in the table [config]";
  }

  Instance instance(const Image& image, const rung_instance_options& options) override {
    rung_instance_options own = options;
    own.request = nullptr; // the simulated control answers
    check(api::newInstance(image.handle(), &own, std::move(made_), &instance_));
    return Instance(instance_);
  }

  std::vector<std::string> problems() const override {
    std::vector<std::string> texts;
    for (const sim::NcProblem& problem : nc_.connectionProblems()) texts.push_back(problem.text);
    return texts;
  }

  std::string event(const std::string& name, const nlohmann::json& keys) override try {
    Arguments arguments;
    for (const auto& [key, value] : keys.items()) arguments.push_back(argumentOf(key, value));
    runtime::Instance& inside = api::insideOf(*instance_);
    const auto* statement = std::ranges::find(kStatements, name, &Statement::name);
    std::string problem = statement == std::end(kStatements) ? nc_.event(inside, name, arguments)
                                                             : statement->carryOut(nc_, inside, arguments);
    api::takeMessages(*instance_);
    return problem;
  } catch (const std::exception& problem) {
    return problem.what();
  }

private:
  std::span<const nc::ConfigKey> keys_;
  std::unique_ptr<sim::SimulatedNc> made_; // until it is passed to the instance
  sim::SimulatedNc& nc_;
  rung_instance* instance_ = nullptr; // owned by the host
};

} // namespace
} // namespace rung::rung_run

// Identifies the build, because the interface is C++: rung-run accepts only its own build.
extern "C" const char* rung_plugin_build() {
  static const std::string build = rung::rung_run::simulationBuild();
  return build.c_str();
}

extern "C" rung::rung_run::Simulation* rung_make_simulation(const char* dialect) {
  return new rung::rung_run::SimulatedControl(dialect);
}
