// The common part of all simulated NCs (see simulated_nc.h).
#include "sim/simulated_nc.h"

#include <filesystem>

namespace rung::sim {

std::string SimulatedNc::config(std::string_view key, std::string_view) {
  return "unknown configuration key '" + std::string(key) + "'";
}

std::string SimulatedNc::inFolder(std::string_view file) const {
  return (std::filesystem::path(folder_) / file).lexically_normal().string();
}

std::string SimulatedNc::connect(std::string_view, std::string_view) { return "this dialect has no connections"; }

void SimulatedNc::powerOn(runtime::Instance& instance, nc::PowerOn kind) {
  log_.clear();
  control().powerOn(instance, kind);
}

void SimulatedNc::save(core::Saver& saver) const noexcept {
  Environment::save(saver);
  saver(quantities_);
}

void SimulatedNc::load(runtime::Instance& instance, core::Loader& loader) {
  Environment::load(instance, loader);
  loader(quantities_);
}

// ---- messages ----------------------------------------------------------------------------------------------------

namespace {

std::string logLine(const nc::Control& control, const rung_program& program, const rung_message& message) {
  std::string line(nc::kMessageLine, '\0');
  size_t length = control.describe(program, message, line);
  while (length == line.size()) {
    line.resize(2 * line.size());
    length = control.describe(program, message, line);
  }
  line.resize(length);
  return line;
}

} // namespace

bool SimulatedNc::isLogged(const rung_message& message) const {
  return message.op == RUNG_MESSAGE_SHOW_LOG || message.op == RUNG_MESSAGE_LOG;
}

void SimulatedNc::accept(const runtime::Instance& instance, const rung_message& message) {
  if (isLogged(message)) log_.push_back(logLine(control(), instance.program(), message));
  control().accept(message);
}

std::optional<NcCell> SimulatedNc::readCell(std::string_view) const { return std::nullopt; }
std::optional<std::string> SimulatedNc::writeCell(std::string_view, const NcCell&) { return std::nullopt; }
std::string SimulatedNc::cellProblem(std::string_view) const { return {}; }
bool SimulatedNc::cellMayCome(std::string_view) const { return false; }

std::string SimulatedNc::setQuantity(std::string_view name, double value) {
  quantities_.insert_or_assign(std::string(name), value);
  return {};
}

std::optional<double> SimulatedNc::quantity(std::string_view name) const {
  auto found = quantities_.find(name);
  if (found == quantities_.end()) return std::nullopt;
  return found->second;
}

std::string SimulatedNc::blockStart(runtime::Instance&, const std::vector<NcArgument>&) {
  return "this dialect's NC starts no blocks";
}
std::string SimulatedNc::blockDone(runtime::Instance&) { return "this dialect's NC starts no blocks"; }
std::string SimulatedNc::event(runtime::Instance&, std::string_view name, const std::vector<NcArgument>&) {
  std::string known;
  for (const std::string_view event : events()) known += (known.empty() ? "; there are " : ", ") + std::string(event);
  return "unknown event '" + std::string(name) + "'" + known;
}
std::string SimulatedNc::expectSent(std::string_view, const std::vector<NcArgument>&) {
  return "this dialect's NC has no ports to send by";
}
std::string SimulatedNc::plcCommand(runtime::Instance&, std::string_view) {
  return "this dialect has no operator commands to the PLC";
}

namespace {

class SimulatedPlain final : public SimulatedNc {
public:
  nc::Control& control() override { return control_; }
  const nc::Control& control() const override { return control_; }

private:
  nc::Control control_;
};

} // namespace

std::unique_ptr<SimulatedNc> makeSimulatedPlain() { return std::make_unique<SimulatedPlain>(); }

std::unique_ptr<SimulatedNc> makeSimulatedNc(std::string_view dialect) {
  if (dialect == "fanuc") return makeSimulatedFanuc();
  if (dialect == "gsk") return makeSimulatedGsk();
  if (dialect == "nct") return makeSimulatedNct();
  if (dialect == "technol") return makeSimulatedTechnol();
  return makeSimulatedPlain();
}

} // namespace rung::sim
