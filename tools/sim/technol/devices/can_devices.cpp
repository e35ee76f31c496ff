// The simulated CAN devices (see can_devices.h). Their configuration is in can_configuration.cpp.
#include "tools/sim/technol/devices/can_devices.h"

namespace rung::sim::technol {

using namespace devices;

namespace {

constexpr uint32_t kDriveChannel = 1, kUnitChannel = 2;

std::string noChannel(uint32_t channel) { return "CAN channel " + std::to_string(channel) + " is not active"; }

} // namespace

CanDevices::CanDevices()
    : channels_{CanChannel(1, orders_), CanChannel(2, orders_)}, buses_{SimulatedCanBus(1), SimulatedCanBus(2)} {}

void CanDevices::power() {
  orders_.clear();
  for (uint32_t i = 0; i < channels_.size(); ++i) {
    channels_[i].reset();
    buses_[i].power();
    channels_[i].setState(buses_[i].state());
    received_[i].clear();
    sent_[i].clear();
  }
  unitSide_.reset();
  driveSide_.reset();
}

void CanDevices::tick(const CanInputs& in, CanOutputs& out) {
  for (SimulatedUnit& unit : buses_[kUnitChannel - 1].units())
    if (unit.group() == kInOut08)
      std::copy_n(&in.terminals[kUnitInputs * (unit.board() - 1)], kUnitInputs, unit.wires().in.begin());
  driveSide_.tick(in.drives, out.drives, buses_[kDriveChannel - 1]);
  unitSide_.tick(in.units, out.units, buses_[kUnitChannel - 1]);
  for (uint32_t channel = 1; channel <= channels_.size(); ++channel) exchange(channel);
}

void CanDevices::exchange(uint32_t number) {
  CanChannel& own = channels_[number - 1];
  SimulatedCanBus& bus = buses_[number - 1];
  own.setState(bus.state());
  CanPacket packet;
  while (bus.state() == BusState::Active && own.peekToSend(packet) && bus.transmit(packet)) {
    own.takeToSend(packet);
    sent_[number - 1].pushAnyway(packet);
  }
  bus.tick();
  while (bus.receive(packet)) {
    const bool isTaken = number == kDriveChannel ? driveSide_.take(packet) : unitSide_.take(packet);
    if (!isTaken) received_[number - 1].pushAnyway(packet);
  }
}

bool CanDevices::readItem(uint32_t channel, uint32_t group, uint32_t board, InoutsItem item, uint32_t& value) const {
  return channel == kUnitChannel && channels_[channel - 1].isActive() && unitSide_.read(group, board, item, value);
}

bool CanDevices::writeItem(uint32_t channel, uint32_t group, uint32_t board, InoutsItem item, uint32_t value) {
  return channel == kUnitChannel && channels_[channel - 1].isActive() && unitSide_.write(group, board, item, value);
}

// ---- scenarios ------------------------------------------------------------------------------------------------------

std::string CanDevices::packetEvent(uint32_t channel, const CanPacket& packet) {
  if (channel < 1 || channel > channels_.size()) return "CAN channels are 1 and 2";
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
  if (channel < 1 || channel > channels_.size()) return "CAN channels are 1 and 2";
  if (!buses_[channel - 1].isActive()) return noChannel(channel);
  buses_[channel - 1].setOff(off);
  channels_[channel - 1].setState(buses_[channel - 1].state());
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
