// The simulated NC of a TECHNOL PLC: configuration, connections and events, and the operator's commands (man. ch. 3.17,
// 5, 14, 16, 27).
#include <iterator>
#include <span>

#include "machine/host/control_files.h"
#include "rtlib/nc/config_key.h"
#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/nc/control/technol/technol_control.h"
#include "rtlib/nc/faults.h"
#include "rtlib/nc/technol/services.h"
#include "rtlib/text/letters.h"
#include "sim/simulated_nc.h"
#include "sim/technol/configuration.h"
#include "sim/technol/events.h"
#include "sim/technol/exchange.h"
#include "sim/technol/requests/simulated_devices.h"

namespace rung::sim {
namespace {

constexpr std::string_view kConfirm = "CONFIRM", kHalt = "HALT"; // events

class SimulatedTechnol final : public SimulatedNc {
public:
  nc::Control& control() override { return control_; }
  const nc::Control& control() const override { return control_; }

  void powerOn(runtime::Instance& instance, nc::PowerOn kind) override {
    log_.clear();
    control_.prepare(instance, kind);
    devices_.powerOn(instance, kind, [this](std::string_view id) { return configuration_.constant(id); });
    if (devices_.simulated()) {
      exchange_.cells().simulate(devices_.image());
      exchange_.cells().addShared();
    }
    nc::technol::writeCell(instance, nc::kLicenceCell, configuration_.licences());
    exchange_.beforeInit(instance, true);
    control_.start(instance);
    exchange_.afterInit(instance);
    instance.worksChanged();
  }

  uint32_t works() const override { return control_.works() | exchange_.works(); }
  void onHook(runtime::Instance& instance, uint32_t work) override {
    if (work == nc::kHookBeforeInput) {
      devices_.beforeInput(instance, exchange_.cells());
      devices_.takeLog(log_);
    }
    if (work != nc::kHookAfterInput) exchange_.onHook(instance, work);
    control_.onHook(instance, work);
  }

  void afterPart(runtime::Instance& instance) override {
    SimulatedNc::afterPart(instance);
    if (instance.stopped()) idle(instance);
  }
  void idle(runtime::Instance& instance) override {
    devices_.idle(instance, exchange_.cells());
    exchange_.idle(instance);
    devices_.takeLog(log_);
  }

  void onFault(runtime::Instance& instance) override {
    control_.onFault(instance);
    devices_.fault(instance);
  }

  void programChanged(runtime::Instance& instance, const rung_program& former) override {
    exchange_.programChanged(instance);
    devices_.programChanged(instance, former);
  }

  void save(core::Saver& saver) const noexcept override {
    SimulatedNc::save(saver);
    saver(*this);
  }
  void load(runtime::Instance& instance, core::Loader& loader) override {
    SimulatedNc::load(instance, loader);
    loader(*this);
    loader.require(exchange_.settle(instance));
  }
  template <class Archive>
  void state(Archive& archive) {
    archive(exchange_, devices_);
  }

  std::string config(std::string_view key, std::string_view value) override {
    if (const nc::ConfigKey* row = findConfigKey(nc::technolConfigKeys(), key))
      if (std::string wrong = wrongValue(*row, key, value); !wrong.empty()) return wrong;
    constexpr std::string_view kKeys[] = {"PlcErrors", "PlcConstants", "PlcConfig"}; // of files, by ControlFileKind
    for (size_t i = 0; i < std::size(kKeys); ++i)
      if (key == kKeys[i]) return readFile(static_cast<host::ControlFileKind>(i), value);
    if (const auto wrong = devices_.configure(key, value, inFolder(value)); wrong && !wrong->empty())
      return *wrong;
    else if (wrong && text::upper(key).find("INOUT08[") == std::string_view::npos)
      return {};
    std::string problem = exchange_.configure(key, value);
    return problem.empty() ? configuration_.set(key, value) : problem;
  }
  std::string connect(std::string_view source, std::string_view destination) override {
    exchange_.connect(source, destination);
    return {};
  }
  std::vector<NcProblem> connectionProblems() const override {
    std::vector<NcProblem> problems = exchange_.problems();
    for (const std::string& text : devices_.problems()) problems.push_back({.connection = RUNG_NONE, .text = text});
    return problems;
  }
  uint32_t retainedSize() override { return devices_.retainedSize(); }
  void copyRetained(std::span<uint8_t> image) noexcept override { devices_.copyRetained(image); }
  void restoreRetained(std::span<const uint8_t> image) override { devices_.restoreRetained(image); }

  // Shared variables can be found by their names, too; screens write only inputs (man. l.13609).
  std::optional<runtime::Ref> readPlace(const rung_program& program, std::string_view name) const override {
    const auto place = control_.readPlace(program, name);
    return place ? place : exchange_.shared().find(name, false);
  }
  std::optional<runtime::Ref> writePlace(const rung_program& program, std::string_view name) const override {
    const auto place = control_.readPlace(program, name);
    return place ? place : exchange_.shared().find(name, true);
  }
  void beforeWrite(runtime::Instance& instance, const runtime::Ref& place) override {
    exchange_.beforeWrite(instance, place);
  }
  std::optional<NcCell> readCell(std::string_view name) const override {
    const auto cell = devices_.readCell(name);
    return cell ? cell : exchange_.cells().read(name);
  }
  std::optional<std::string> writeCell(std::string_view name, const NcCell& value) override {
    auto problem = devices_.writeCell(name, value);
    if (problem || !exchange_.cells().write(name, value)) return problem;
    return std::string();
  }
  std::string cellProblem(std::string_view name) const override { return devices_.cellProblem(name); }
  bool cellMayCome(std::string_view name) const override { return devices_.cellMayCome(name); }
  std::optional<double> quantity(std::string_view name) const override {
    const auto value = devices_.quantity(name);
    return value ? value : SimulatedNc::quantity(name);
  }
  std::string setQuantity(std::string_view name, double value) override {
    const auto done = devices_.setQuantity(name, value);
    return done ? *done : SimulatedNc::setQuantity(name, value);
  }
  std::string expectSent(std::string_view port, const std::vector<NcArgument>& keys) override {
    return devices_.expectSent(port, keys);
  }

  std::string blockStart(runtime::Instance& instance, const std::vector<NcArgument>& keys) override;
  std::string blockDone(runtime::Instance& instance) override {
    return control_.blocks().reached(instance) ? "" : "no block is in motion";
  }

  std::vector<std::string_view> events() const override {
    std::vector<std::string_view> names{kConfirm, kHalt};
    for (const std::vector<std::string_view>& more : {technol::programEvents(), devices_.events()})
      names.insert(names.end(), more.begin(), more.end());
    return names;
  }
  std::string event(runtime::Instance& instance, std::string_view name, const std::vector<NcArgument>& keys) override {
    if (text::equalsIgnoringCase(name, kConfirm)) {
      control_.list().confirm();
      return {};
    }
    if (text::equalsIgnoringCase(name, kHalt)) {
      instance.halt(nc::kTechnolRequested);
      return {};
    }
    const auto constant = [this](std::string_view id) { return configuration_.constant(id); };
    if (const auto done = devices_.event(instance, name, keys)) {
      devices_.takeLog(log_);
      return *done;
    }
    const std::optional<std::string> answer = technol::callEvent(instance, name, keys, constant);
    return answer ? *answer : SimulatedNc::event(instance, name, keys);
  }

  void answered(runtime::Instance& instance, const core::ServiceRequest& request, std::string_view bytes) override {
    technol::showLateAnswer(instance, request, bytes);
  }

  std::string plcCommand(runtime::Instance& instance, std::string_view command) override {
    if (command == "stop") {
      control_.life().stop(instance);
    } else if (command == "start") {
      control_.list().clear(); // as at power-up
      start(instance);
    } else {
      control_.life().clear(instance);
    }
    return {};
  }

protected:
  bool serve(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) override {
    if (devices_.respond(instance, request, reply)) {
      devices_.takeLog(log_);
      return true;
    }
    if (exchange_.respond(instance, request, reply)) return true;
    if (io::kindOf(request) != io::ServiceKind::Configuration) return false;
    configuration_.respond(request, reply);
    return true;
  }
  bool isLogged(const rung_message& message) const override { return control_.list().begins(message); }

private:
  std::string readFile(host::ControlFileKind kind, std::string_view file) {
    host::ControlFiles files = files_;
    std::string wrong = host::readControlFile(kind, inFolder(file), files);
    const auto added = [](const auto& all, const auto& earlier) { return std::span(all).subspan(earlier.size()); };
    if (wrong.empty())
      wrong =
          configuration_.define(added(files.parameters, files_.parameters), added(files.constants, files_.constants));
    if (wrong.empty()) wrong = devices_.define(added(files.devices, files_.devices));
    if (!wrong.empty()) return wrong;
    exchange_.take(added(files.connections, files_.connections), added(files.terminals, files_.terminals));
    files_ = std::move(files);
    for (const nc::technol::MessageDefinition& message : files_.messages) control_.list().define(message);
    return {};
  }

  // Starts the program; MODULE_INIT defines its variables again.
  void start(runtime::Instance& instance) {
    exchange_.beforeInit(instance, false);
    devices_.startProgram();
    control_.life().start(instance);
    exchange_.afterInit(instance);
  }

  nc::TechnolControl control_;
  host::ControlFiles files_;
  technol::Configuration configuration_;
  technol::Exchange exchange_;
  technol::SimulatedDevices devices_;
};

// Starts a block; the keys are names of cells of the command block.
std::string SimulatedTechnol::blockStart(runtime::Instance& instance, const std::vector<NcArgument>& keys) {
  if (control_.blocks().busy()) return "a block is already under way";
  std::vector<nc::technol::CommandValue> values;
  for (const NcArgument& cell : keys) {
    if (cell.isText) return "'" + cell.key + "' is a number, not a text";
    const auto place = nc::technol::commandCell(instance, cell.key);
    if (!place) return "unknown signal '" + cell.key + "'";
    if (place->kind == runtime::RefKind::Bit && (cell.isReal || (cell.integer != 0 && cell.integer != 1)))
      return "'" + cell.key + "' is a bit";
    const bool isReal = cell.isReal || place->kind == runtime::RefKind::Real;
    values.push_back({runtime::locate(instance.memory(), *place), isReal, cell.integer, cell.real});
  }
  control_.blocks().start(instance, values);
  devices_.blockStarted(instance);
  return {};
}

} // namespace

std::unique_ptr<SimulatedNc> makeSimulatedTechnol() { return std::make_unique<SimulatedTechnol>(); }

} // namespace rung::sim
