// A simulated bus (see can_bus.h).
#include "tools/sim/technol/devices/can_bus.h"

namespace rung::sim::technol {

using namespace devices;

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

// SYNC and network management are for all nodes.
void SimulatedCanBus::distribute(const CanPacket& packet) {
  const uint8_t node = packet.node();
  for (SimulatedUnit& unit : units_)
    if (node == 0 || node == unit.node()) unit.receive(packet, answers_);
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

} // namespace rung::sim::technol
