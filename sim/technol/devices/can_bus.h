// One simulated CAN bus: what the control transmits reaches the nodes in the next tick, and their answers come back in
// the same one.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "machine/io/can/settings.h"
#include "sim/technol/devices/can_unit.h"

namespace rung::sim::technol {

class SimulatedCanBus final : public io::CanPort {
public:
  // `number` is 1 or 2.
  explicit SimulatedCanBus(uint32_t number) : number_(number) {}

  uint32_t number() const { return number_; }
  // Of the configuration.
  void setActive(bool active) { active_ = active; }
  bool isActive() const { return active_; }
  // So many of the group; they are new ones if there were more or fewer.
  void setUnits(uint32_t group, uint32_t count);
  std::span<SimulatedUnit> units() { return units_; }
  std::span<const SimulatedUnit> units() const { return units_; }
  std::vector<SimulatedDrive>& drives() { return drives_; }
  const std::vector<SimulatedDrive>& drives() const { return drives_; }

  void power();
  void tick();
  // The controller has left the bus, or is back. Nothing that was under way arrives.
  void setOff(bool off);
  // A packet of a node that is not simulated; false: there is no room for it in this tick.
  bool inject(const io::CanPacket& packet);
  NodePackets& answers() { return answers_; }

  io::BusState state() const override;
  bool transmit(const io::CanPacket& packet) override;
  bool receive(io::CanPacket& packet) override { return answers_.pop(packet); }

private:
  void distribute(const io::CanPacket& packet);

  uint32_t number_;
  bool active_ = false, off_ = false;
  std::vector<SimulatedUnit> units_;
  std::array<uint8_t, io::kCanNode + 1> numbers_{}; // of units in `units_` by node, from 1; 0: no unit
  std::vector<SimulatedDrive> drives_;
  NodePackets wire_;    // from the control, and from outside
  NodePackets answers_; // to the control
};

// The CAN devices of the simulated control: two buses, of which the first one has drives and the second one I/O units,
// panels and handwheels (man. ch. 9, 13.14), and the control's side of them, which a real bus would have, too
// (io::CanController). What comes and goes is plain data: it knows no program and no scenario.
//
// Order of things: configure; power; then a tick a millisecond.

struct CanInputs {
  io::UnitOrders units;
  io::DriveOrders drives;
  // At the terminals of INOUT08: P1IN and on. Those of panels and handwheels are in their UnitWires.
  std::array<uint8_t, io::kInputPorts> terminals{};
};

struct CanOutputs {
  io::UnitStates units;
  io::DriveStates drives;
};

// event CAN_UNIT: keys that it has not are empty.
struct CanUnitEvent {
  std::optional<uint8_t> error;                                // register 1001h; 0: gone
  std::array<std::optional<uint8_t>, io::kUnitOutputs> shorts; // of OP0 to OP2
  std::optional<bool> silent;
};

// event CAN_DRIVE
struct CanDriveEvent {
  std::optional<uint16_t> fault; // error code of the emergency; 0: its cause is gone
  bool hold = false;             // the cause stays
  std::optional<uint16_t> mstat; // CAN_DRIVE_MSTAT
  std::optional<bool> silent;
};

class CanDevices {
public:
  CanDevices();
  CanDevices(const CanDevices&) = delete;
  CanDevices& operator=(const CanDevices&) = delete;

  // "CAN[1].InOut08Cnt", "CAN[1].INOUT08[0].CONTROL", "CAN[0].Drives", "drive.2.type" ... "" done, a text: what is
  // wrong; nothing: a key of something else. Names in any case.
  std::optional<std::string> configure(std::string_view key, std::string_view value);

  // Power off and on: everything starts anew and whole, what is wired to the units stays. Units have their mapping
  // before the first tick, as the program of a control begins when its bus is ready.
  void power();
  // After that, where a scenario answers for the devices: no bus, but orders of packets on both channels.
  void openForScenario();
  void tick(const CanInputs& in, CanOutputs& out);
  // Instructions, packets, messages.
  io::CanController& control() { return control_; }

  // ---- what a scenario does and sees; "" or what is wrong

  std::string packetEvent(uint32_t channel, const io::CanPacket& packet);
  // The same without a bus.
  void scriptedPacket(uint32_t channel, const io::CanPacket& packet) { control_.putReceived(channel, packet); }
  std::string unitEvent(uint32_t group, uint32_t board, const CanUnitEvent& event);
  std::string driveEvent(uint32_t drive, const CanDriveEvent& event);
  std::string busEvent(uint32_t channel, bool off);

  // Null: there is no such unit. Boards from 1.
  UnitWires* wires(uint32_t group, uint32_t board);
  const io::Inouts* inouts(uint32_t group, uint32_t board) const { return control_.units().find(group, board); }
  const SimulatedUnit* unit(uint32_t group, uint32_t board) const;
  // An object of a drive; nothing: it has no object of these numbers.
  std::optional<uint32_t> driveObject(uint32_t drive, uint32_t index, uint32_t subindex) const;
  uint32_t drives() const { return control_.drives().count(); }

private:
  using Problem = std::optional<std::string>;

  void prepareUnits();
  Problem configureObject(std::string_view key, std::string_view value);
  void follow(const io::CanSettings& settings);
  void setDrives(uint32_t count);
  SimulatedUnit* findUnit(uint32_t group, uint32_t board);
  SimulatedDrive* findDrive(uint32_t drive);

  std::array<SimulatedCanBus, io::CanController::kChannels> buses_{SimulatedCanBus(1), SimulatedCanBus(2)};
  io::CanController control_;
  io::CanSettings settings_;
};

} // namespace rung::sim::technol
