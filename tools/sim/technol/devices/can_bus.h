// One simulated CAN bus: what the control transmits reaches the nodes in the next tick, and their answers come back in
// the same one.
#pragma once
#include <vector>

#include "tools/sim/technol/devices/can_drive.h"
#include "tools/sim/technol/devices/can_unit.h"

namespace rung::sim::technol {

class SimulatedCanBus final : public devices::CanPort {
public:
  // `number` is 1 or 2.
  explicit SimulatedCanBus(uint32_t number) : number_(number) {}

  uint32_t number() const { return number_; }
  // Of the configuration.
  void setActive(bool active) { active_ = active; }
  bool isActive() const { return active_; }
  std::vector<SimulatedUnit>& units() { return units_; }
  const std::vector<SimulatedUnit>& units() const { return units_; }
  std::vector<SimulatedDrive>& drives() { return drives_; }
  const std::vector<SimulatedDrive>& drives() const { return drives_; }

  void power();
  void tick();
  // The controller has left the bus, or is back. Nothing that was under way arrives.
  void setOff(bool off);
  // A packet of a node that is not simulated; false: there is no room for it in this tick.
  bool inject(const devices::CanPacket& packet);
  NodePackets& answers() { return answers_; }

  devices::BusState state() const override;
  bool transmit(const devices::CanPacket& packet) override;
  bool receive(devices::CanPacket& packet) override { return answers_.pop(packet); }

private:
  void distribute(const devices::CanPacket& packet);

  uint32_t number_;
  bool active_ = false, off_ = false;
  std::vector<SimulatedUnit> units_;
  std::vector<SimulatedDrive> drives_;
  NodePackets wire_;    // from the control, and from outside
  NodePackets answers_; // to the control
};

} // namespace rung::sim::technol
