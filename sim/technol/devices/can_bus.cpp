// A simulated bus.
#include "sim/technol/devices/can_bus.h"

#include <algorithm>

#include "machine/host/xml_reader.h"
#include "machine/io/device_call.h"
#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::sim::technol {

using namespace io;

void SimulatedCanBus::setUnits(uint32_t group, uint32_t count) {
  const auto isOfGroup = [&](const SimulatedUnit& unit) { return unit.group() == group; };
  if (static_cast<uint32_t>(std::ranges::count_if(units_, isOfGroup)) == count) return;
  std::erase_if(units_, isOfGroup);
  for (uint32_t board = 1; board <= count; ++board) units_.emplace_back(group, board);
  numbers_ = {};
  for (size_t i = 0; i < units_.size(); ++i) numbers_[units_[i].node()] = static_cast<uint8_t>(i + 1);
}

void SimulatedCanBus::power() {
  off_ = false;
  wire_.clear();
  answers_.clear();
  for (SimulatedUnit& unit : units_) unit.power();
  for (SimulatedDrive& drive : drives_) drive.power();
}

void SimulatedCanBus::tick() {
  if (state() != BusState::Active) return;
  for (CanPacket packet; wire_.pop(packet);) distribute(packet);
  for (SimulatedUnit& unit : units_) unit.tick(answers_);
}

// SYNC and network management go to all nodes.
void SimulatedCanBus::distribute(const CanPacket& packet) {
  const uint8_t node = packet.node();
  if (node == 0)
    for (SimulatedUnit& unit : units_) unit.receive(packet, answers_);
  else if (const uint32_t number = numbers_[node])
    units_[number - 1].receive(packet, answers_);
  for (SimulatedDrive& drive : drives_)
    if (node == 0 || node == drive.node()) drive.receive(packet, answers_);
}

void SimulatedCanBus::setOff(bool off) {
  off_ = off;
  wire_.clear();
  answers_.clear();
}

bool SimulatedCanBus::inject(const CanPacket& packet) {
  const CanPacket clean = onBus(packet);
  return state() == BusState::Active && wire_.push(clean) && answers_.push(clean);
}

BusState SimulatedCanBus::state() const {
  return !active_ ? BusState::Inactive : off_ ? BusState::BusOff : BusState::Active;
}

bool SimulatedCanBus::transmit(const CanPacket& packet) {
  return state() == BusState::Active && wire_.push(onBus(packet));
}

// Keys of the CAN devices: those of the control's channels, and objects of the simulated drives.

using namespace io;

namespace {

using host::inQuotes;

// Takes the drive's number from "DRIVE.2.SDO.0X2003.1", and leaves the part after SDO in `name`.
std::optional<uint32_t> takeDriveOfObject(std::string_view& name) {
  if (!nc::technol::takePrefix(name, "DRIVE.")) return std::nullopt;
  const auto drive = numberBetween(takeUntil(name, '.'), 0, UINT32_MAX);
  return nc::technol::takePrefix(name, "SDO.") ? drive : std::nullopt;
}

} // namespace

std::optional<std::string> CanDevices::configure(std::string_view key, std::string_view value) {
  if (const Problem object = configureObject(key, value)) return object;
  const Problem wrong = settings_.set(key, value);
  if (wrong && wrong->empty()) follow(settings_);
  return wrong;
}

void CanDevices::follow(const CanSettings& settings) {
  settings.configure(control_);
  SimulatedCanBus& ofUnits = buses_[CanController::kUnitChannel - 1];
  for (uint32_t group = 1; group <= kUnitGroups; ++group) ofUnits.setUnits(group, settings.units[group - 1]);
  setDrives(settings.drives);
  for (uint32_t i = 0; i < settings.drives; ++i) findDrive(i + 1)->setType(settings.driveTypes[i]);
  for (SimulatedCanBus& bus : buses_) bus.setActive(settings.isActive(bus.number()));
}

void CanDevices::setDrives(uint32_t count) {
  std::vector<SimulatedDrive>& drives = buses_[CanController::kDriveChannel - 1].drives();
  while (drives.size() > count) drives.pop_back();
  while (drives.size() < count) drives.emplace_back(static_cast<uint32_t>(drives.size() + 1));
}

// The value is VALUE/BYTES, optionally followed by `ro` or `wo`.
std::optional<std::string> CanDevices::configureObject(std::string_view key, std::string_view value) {
  const std::string name = nc::technol::canonical(key);
  std::string_view rest = name;
  const auto of = takeDriveOfObject(rest);
  if (!of) return std::nullopt;
  SimulatedDrive* const drive = findDrive(*of);
  if (drive == nullptr)
    return inQuotes(key) + " is of no drive; there are " + std::to_string(drives()) + " (CAN[0].Drives comes first)";
  const auto index = numberBetween(text::lower(takeUntil(rest, '.')), 0, 0xFFFF);
  const auto subindex = numberBetween(text::lower(rest), 0, 0xFF);
  if (!index || !subindex) return inQuotes(key) + " does not name an object; expected sdo.0x2003.1";
  std::string_view left = text::trimmed(value);
  const std::string_view number = takeUntil(left, '/');
  const auto bytes = numberBetween(takeUntil(left, ' '), 1, 4);
  const std::string_view access = text::trimmed(left);
  const bool isAccess = access.empty() || access == "ro" || access == "wo";
  const int64_t end = bytes ? int64_t{1} << 8 * *bytes : 0;
  const auto content = bytes && *bytes != 3 && isAccess ? nc::technol::integerOf(number) : std::nullopt;
  if (!content || *content >= end || *content < -end / 2)
    return inQuotes(key) + " takes VALUE/BYTES with 1, 2 or 4 bytes, and 'ro' or 'wo' after it";
  drive->addObject({{static_cast<uint16_t>(*index), static_cast<uint8_t>(*subindex)},
                    *bytes,
                    static_cast<uint32_t>(*content) & static_cast<uint32_t>(end - 1),
                    access == "ro"   ? ObjectAccess::ReadOnly
                    : access == "wo" ? ObjectAccess::WriteOnly
                                     : ObjectAccess::ReadWrite});
  return "";
}

// The simulated CAN devices.

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

// Prepares the units, each of which answers after some milliseconds, far fewer than kMostMs.
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
