// A simulated drive on CAN channel 1: Kollmorgen (or Berger-Lahr), by the states of CiA 402, or Unidrive (man. 13.14).
#pragma once
#include "machine/io/can/drives.h"
#include "sim/technol/devices/can_objects.h"
#include "sim/technol/devices/can_unit.h"

namespace rung::sim::technol {

class SimulatedDrive {
public:
  explicit SimulatedDrive(uint32_t number);

  uint8_t node() const { return node_; }
  void setType(io::DriveType type) { type_ = type; }
  // Objects of the configuration; they have their values again after a power-on.
  void addObject(const CanObject& object);
  const CanObjects& objects() const { return objects_; }

  void power();
  void receive(const io::CanPacket& packet, NodePackets& answers);

  // ---- what a scenario does with it

  // An emergency with this error code. `holds`: its cause stays, so that it cannot be reset. 0: the cause is gone.
  void fault(uint16_t code, bool holds, NodePackets& answers);
  void setManufacturerStatus(uint16_t status) { manufacturer_ = status; }
  void setSilent(bool silent) { silent_ = silent; }

private:
  enum class State : uint8_t { SwitchOnDisabled, ReadyToSwitchOn, SwitchedOn, Enabled, Fault };

  void control(uint16_t word, NodePackets& answers);
  void follow(uint16_t word);
  void resetFault();
  uint16_t status() const;
  void sendStatus(NodePackets& answers) const;
  void refresh();
  void answer(const io::CanPacket& request, NodePackets& answers);

  uint8_t node_;
  io::DriveType type_ = io::DriveType::Kollmorgen;
  CanObjects objects_{io::sdo::kNoSuchSubindex};
  std::vector<CanObject> configured_;
  bool operational_ = false, silent_ = false;
  State state_ = State::SwitchOnDisabled;
  uint16_t word_ = 0;     // control word; of a Unidrive the bits that its masks let in
  uint16_t received_ = 0; // RPDO1, taken over with SYNC
  uint16_t code_ = 0;     // of the fault
  bool holds_ = false;
  uint16_t manufacturer_ = 0;
};

} // namespace rung::sim::technol
