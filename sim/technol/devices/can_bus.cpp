// A simulated bus (see can_bus.h).
#include "sim/technol/devices/can_bus.h"

#include <algorithm>

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

// SYNC and network management are for all nodes.
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

} // namespace rung::sim::technol
