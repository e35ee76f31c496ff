// One simulated CAN bus: packets of the control reach the nodes in the next tick, and their answers return in the same
// tick.
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
  // From the configuration.
  void setActive(bool active) { active_ = active; }
  bool isActive() const { return active_; }
  // Sets the number of units in a group; a change of the number creates new ones.
  void setUnits(uint32_t group, uint32_t count);
  std::span<SimulatedUnit> units() { return units_; }
  std::span<const SimulatedUnit> units() const { return units_; }
  std::vector<SimulatedDrive>& drives() { return drives_; }
  const std::vector<SimulatedDrive>& drives() const { return drives_; }

  void power();
  void tick();
  // The controller has left the bus, or returned. Packets in transit are lost.
  void setOff(bool off);
  // Sends a packet of a node that is not simulated; returns false if there is no room for it in this tick.
  bool inject(const io::CanPacket& packet);
  NodePackets& answers() { return answers_; }

  io::BusState state() const override;
  bool transmit(const io::CanPacket& packet) override;
  bool receive(io::CanPacket& packet) override { return answers_.pop(packet); }

  template <class Archive>
  void state(Archive& archive) {
    archive(off_, wire_, answers_);
    archive.each(units_);
    archive.each(drives_);
  }

private:
  void distribute(const io::CanPacket& packet);

  uint32_t number_;
  bool active_ = false, off_ = false;
  std::vector<SimulatedUnit> units_;
  std::array<uint8_t, io::kCanNode + 1> numbers_{}; // position in `units_`, from 1, by node; 0: no unit
  std::vector<SimulatedDrive> drives_;
  NodePackets wire_;    // packets of the control and from outside
  NodePackets answers_; // packets for the control
};

// The CAN devices of the simulated control: two buses, the first with drives, the second with I/O units, panels and
// handwheels (man. ch. 9, 13.14), and the control's side, which is the same for a real bus (io::CanController). Its
// inputs and outputs are plain data, independent of programs and scenarios.
//
// Order of calls: configure; power; then one tick per millisecond.

struct CanInputs {
  io::UnitOrders units;
  io::DriveOrders drives;
  // Terminals of INOUT08: from P1IN on. Those of panels and handwheels are in their UnitWires.
  std::array<uint8_t, io::kInputPorts> terminals{};
};

struct CanOutputs {
  io::UnitStates units;
  io::DriveStates drives;
};

// Event CAN_UNIT: missing keys are empty.
struct CanUnitEvent {
  std::optional<uint8_t> error;                                // register 1001h; 0: error gone
  std::array<std::optional<uint8_t>, io::kUnitOutputs> shorts; // of OP0 to OP2
  std::optional<bool> silent;
};

// Event CAN_DRIVE.
struct CanDriveEvent {
  std::optional<uint16_t> fault; // error code of the emergency; 0: its cause is gone
  bool hold = false;             // the cause persists
  std::optional<uint16_t> mstat; // CAN_DRIVE_MSTAT
  std::optional<bool> silent;
};

class CanDevices {
public:
  CanDevices();
  CanDevices(const CanDevices&) = delete;
  CanDevices& operator=(const CanDevices&) = delete;

  // Sets a key: "CAN[1].InOut08Cnt", "CAN[1].INOUT08[0].CONTROL", "CAN[0].Drives", "drive.2.type" ...; case does not
  // matter. Returns "", or the error; nothing if the key is not one of CAN.
  std::optional<std::string> configure(std::string_view key, std::string_view value);

  // Power off and on: everything restarts without faults; the wiring of the units is kept. Units are mapped before the
  // first tick, because a control starts its program when its bus is ready.
  void power();
  // To be called after `power`, if a scenario replaces the devices: there is no bus, but packet subscriptions work on
  // both channels.
  void openForScenario();
  void tick(const CanInputs& in, CanOutputs& out);
  // Instructions, packets, messages.
  io::CanController& control() { return control_; }

  // ---- actions and queries of a scenario; they return "", or the error

  std::string packetEvent(uint32_t channel, const io::CanPacket& packet);
  // The same without a bus.
  void scriptedPacket(uint32_t channel, const io::CanPacket& packet) { control_.putReceived(channel, packet); }
  std::string unitEvent(uint32_t group, uint32_t board, const CanUnitEvent& event);
  std::string driveEvent(uint32_t drive, const CanDriveEvent& event);
  std::string busEvent(uint32_t channel, bool off);

  // Null: there is no such unit. Boards count from 1.
  UnitWires* wires(uint32_t group, uint32_t board);
  const io::Inouts* inouts(uint32_t group, uint32_t board) const { return control_.units().find(group, board); }
  const SimulatedUnit* unit(uint32_t group, uint32_t board) const;
  // The value of a drive's object; nothing: there is no such object.
  std::optional<uint32_t> driveObject(uint32_t drive, uint32_t index, uint32_t subindex) const;
  uint32_t drives() const { return control_.drives().count(); }

  template <class Archive>
  void state(Archive& archive) {
    archive(buses_, control_);
  }

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
