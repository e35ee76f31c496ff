// What all simulated NCs have in common (see nc_model.h).
#include "tools/sim/nc_model.h"

#include <filesystem>

namespace rung::nc {

std::string NcModel::config(std::string_view key, std::string_view) {
  return "unknown configuration key '" + std::string(key) + "'";
}

std::string NcModel::inFolder(std::string_view file) const {
  return (std::filesystem::path(folder_) / file).lexically_normal().string();
}

std::string NcModel::connect(std::string_view, std::string_view) { return "this dialect has no connections"; }

void NcModel::powerOn(host::Instance& instance, PowerOn kind) {
  log_.clear();
  control().powerOn(instance, kind);
}

void NcModel::powerOff(host::Instance& instance) {
  if (!control().powerOff(instance)) return;
  for (uint32_t i = 0; i < Control::kMostLastScans && !instance.faulted() && control().endsLater(instance); ++i)
    scan(instance);
}

void NcModel::scan(host::Instance& instance) {
  instance.scan();
  finishSlice(instance);
}

void NcModel::slot(host::Instance& instance) {
  instance.slot();
  finishSlice(instance);
}

void NcModel::fast(host::Instance& instance) {
  instance.fast();
  finishSlice(instance);
}

void NcModel::finishSlice(host::Instance& instance) {
  takeMessages(instance);
  control().afterSlice(instance);
}

// ---- messages ----------------------------------------------------------------------------------------------------

namespace {

std::string logLine(const Control& control, const rung_program& program, const rung_message& message) {
  std::string line(kMessageLine, '\0');
  size_t length = control.describe(program, message, line);
  while (length == line.size()) {
    line.resize(2 * line.size());
    length = control.describe(program, message, line);
  }
  line.resize(length);
  return line;
}

} // namespace

bool NcModel::isLogged(const rung_message& message) const {
  return message.op == RUNG_MESSAGE_SHOW_LOG || message.op == RUNG_MESSAGE_LOG;
}

void NcModel::takeMessages(host::Instance& instance) {
  rung_message message;
  while (instance.messages().pop(message)) {
    if (isLogged(message)) log_.push_back(logLine(control(), instance.program(), message));
    control().accept(message);
  }
}

std::optional<NcCell> NcModel::readCell(std::string_view) const { return std::nullopt; }
bool NcModel::writeCell(std::string_view, const NcCell&) { return false; }

std::string NcModel::setQuantity(std::string_view name, double value) {
  quantities_.insert_or_assign(std::string(name), value);
  return {};
}

std::optional<double> NcModel::quantity(std::string_view name) const {
  auto found = quantities_.find(name);
  if (found == quantities_.end()) return std::nullopt;
  return found->second;
}

std::string NcModel::blockStart(host::Instance&, const std::vector<NcArgument>&) {
  return "this dialect's NC starts no blocks";
}
std::string NcModel::blockDone(host::Instance&) { return "this dialect's NC starts no blocks"; }
std::string NcModel::event(host::Instance&, std::string_view name, const std::vector<NcArgument>&) {
  return "unknown event '" + std::string(name) + "'";
}
std::string NcModel::plcCommand(host::Instance&, std::string_view) {
  return "this dialect has no operator commands to the PLC";
}

namespace {

class PlainModel final : public NcModel {
public:
  Control& control() override { return control_; }

private:
  Control control_;
};

} // namespace

std::unique_ptr<NcModel> makePlainModel() { return std::make_unique<PlainModel>(); }

std::unique_ptr<NcModel> makeNcModel(std::string_view dialect) {
  if (dialect == "gsk") return makeGskModel();
  if (dialect == "nct") return makeNctModel();
  if (dialect == "technol") return makeTechnolModel();
  return makePlainModel();
}

} // namespace rung::nc
