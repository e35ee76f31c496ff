// One simulated CAN bus: what the control transmits reaches the nodes in the next tick, and their answers come back in
// the same one.
#pragma once
#include <span>
#include <vector>

#include "sim/technol/devices/can_drive.h"
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

} // namespace rung::sim::technol
