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
  if (kind == PowerOn::Cold)
    instance.coldStart();
  else
    instance.warmStart();
  board_.clear();
}

void NcModel::powerOff(host::Instance&) {}

void NcModel::scan(host::Instance& instance) {
  instance.scan();
  takeMessages(instance);
}

void NcModel::slot(host::Instance& instance) {
  instance.slot();
  takeMessages(instance);
}

void NcModel::fast(host::Instance& instance) {
  instance.fast();
  takeMessages(instance);
}

std::optional<host::Ref> NcModel::readPlace(const host::Instance& instance, std::string_view name) const {
  return instance.resolve(name, [&](std::string_view unknown) { return signal(instance, unknown); });
}

std::optional<host::Ref> NcModel::writePlace(const host::Instance& instance, std::string_view name) const {
  return readPlace(instance, name);
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

std::vector<ShownMessage> NcModel::messages(const host::Instance&) const { return board_.shown(); }

std::optional<host::Ref> NcModel::signal(const host::Instance&, std::string_view) const { return std::nullopt; }

std::unique_ptr<NcModel> makeNcModel(std::string_view dialect) {
  if (dialect == "gsk") return makeGskModel();
  if (dialect == "nct") return makeNctModel();
  if (dialect == "technol") return makeTechnolModel();
  return std::make_unique<NcModel>();
}

} // namespace rung::nc
