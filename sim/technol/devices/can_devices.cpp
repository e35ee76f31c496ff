// The simulated CAN devices (see can_devices.h). Their configuration is in can_configuration.cpp.
#include "sim/technol/devices/can_devices.h"

namespace rung::sim::technol {

using namespace io;

namespace {

constexpr uint32_t kDriveChannel = CanController::kDriveChannel, kUnitChannel = CanController::kUnitChannel;

std::string noChannel(uint32_t channel) { return "CAN channel " + std::to_string(channel) + " is not active"; }

} // namespace

CanDevices::CanDevices() {
  for (SimulatedCanBus& bus : buses_) control_.connect(bus.number(), bus);
}

void CanDevices::power() {
  for (SimulatedCanBus& bus : buses_) bus.power();
  control_.power();
  prepareUnits();
}

// Each answers, so that its objects take some milliseconds: far fewer than these.
void CanDevices::prepareUnits() {
  constexpr uint32_t kMostMs = 100;
  SimulatedCanBus& bus = buses_[kUnitChannel - 1];
  for (uint32_t ms = 0; ms < kMostMs && bus.isActive() && !control_.units().areStarted(); ++ms) {
    control_.prepareUnits();
    bus.tick();
    control_.receive();
  }
}

void CanDevices::openForScenario() {
  for (uint32_t channel = 1; channel <= buses_.size(); ++channel) control_.channel(channel).setState(BusState::Active);
}

void CanDevices::tick(const CanInputs& in, CanOutputs& out) {
  for (SimulatedUnit& unit : buses_[kUnitChannel - 1].units())
    if (unit.group() == kInOut08)
      std::copy_n(&in.terminals[size_t{kUnitInputs} * (unit.board() - 1)], kUnitInputs, unit.wires().in.begin());
  control_.transmit(in.units, out.units, in.drives, out.drives);
  for (SimulatedCanBus& bus : buses_) bus.tick();
  control_.receive();
}

// ---- scenarios ------------------------------------------------------------------------------------------------------

std::string CanDevices::packetEvent(uint32_t channel, const CanPacket& packet) {
  if (channel < 1 || channel > buses_.size()) return "CAN channels are 1 and 2";
  SimulatedCanBus& bus = buses_[channel - 1];
  if (!bus.isActive()) return noChannel(channel);
  if (packet.id >= kCanIds) return "identifiers are 0 to 0x7FF";
  if (bus.state() != BusState::Active) return {}; // it is lost
  return bus.inject(packet) ? "" : "too many packets at once";
}

std::string CanDevices::unitEvent(uint32_t group, uint32_t board, const CanUnitEvent& event) {
  UnitWires* const unit = wires(group, board);
  if (unit == nullptr)
    return "there is no unit of group " + std::to_string(group) + " with the number " + std::to_string(board);
  if (event.error) unit->error = *event.error;
  for (uint32_t i = 0; i < kUnitOutputs; ++i) unit->shorts[i] = event.shorts[i].value_or(unit->shorts[i]);
  if (event.silent) unit->silent = *event.silent;
  return {};
}

std::string CanDevices::driveEvent(uint32_t number, const CanDriveEvent& event) {
  SimulatedDrive* const drive = findDrive(number);
  if (drive == nullptr) return "there is no drive " + std::to_string(number);
  if (event.silent) drive->setSilent(*event.silent);
  if (event.mstat) drive->setManufacturerStatus(*event.mstat);
  if (event.fault) drive->fault(*event.fault, event.hold, buses_[kDriveChannel - 1].answers());
  return {};
}

std::string CanDevices::busEvent(uint32_t channel, bool off) {
  if (channel < 1 || channel > buses_.size()) return "CAN channels are 1 and 2";
  if (!buses_[channel - 1].isActive()) return noChannel(channel);
  buses_[channel - 1].setOff(off);
  control_.updateState(channel);
  return {};
}

SimulatedUnit* CanDevices::findUnit(uint32_t group, uint32_t board) {
  for (SimulatedUnit& unit : buses_[kUnitChannel - 1].units())
    if (unit.group() == group && unit.board() == board) return &unit;
  return nullptr;
}

const SimulatedUnit* CanDevices::unit(uint32_t group, uint32_t board) const {
  for (const SimulatedUnit& unit : buses_[kUnitChannel - 1].units())
    if (unit.group() == group && unit.board() == board) return &unit;
  return nullptr;
}

SimulatedDrive* CanDevices::findDrive(uint32_t drive) {
  std::vector<SimulatedDrive>& all = buses_[kDriveChannel - 1].drives();
  return drive >= 1 && drive <= all.size() ? &all[drive - 1] : nullptr;
}

UnitWires* CanDevices::wires(uint32_t group, uint32_t board) {
  SimulatedUnit* const unit = findUnit(group, board);
  return unit == nullptr ? nullptr : &unit->wires();
}

std::optional<uint32_t> CanDevices::driveObject(uint32_t drive, uint32_t index, uint32_t subindex) const {
  const std::vector<SimulatedDrive>& all = buses_[kDriveChannel - 1].drives();
  if (drive < 1 || drive > all.size() || index > 0xFFFF || subindex > 0xFF) return std::nullopt;
  const CanObject* const object =
      all[drive - 1].objects().find({static_cast<uint16_t>(index), static_cast<uint8_t>(subindex)});
  return object == nullptr ? std::nullopt : std::optional(object->value);
}

} // namespace rung::sim::technol
