// Both channels (see controller.h).
#include "machine/io/can/controller.h"

namespace rung::io {

void CanController::power() {
  orders_.clear();
  for (uint32_t channel = 1; channel <= kChannels; ++channel) {
    channels_[channel - 1].reset();
    received_[channel - 1].clear();
    sent_[channel - 1].clear();
    updateState(channel);
  }
  units_.reset();
  drives_.reset();
}

void CanController::updateState(uint32_t channel) { channels_[channel - 1].setState(ports_[channel - 1]->state()); }

void CanController::transmit(const UnitOrders& unitOrders, UnitStates& unitStates, const DriveOrders& driveOrders,
                             DriveStates& driveStates) {
  drives_.tick(driveOrders, driveStates, *ports_[kDriveChannel - 1]);
  units_.tick(unitOrders, unitStates, *ports_[kUnitChannel - 1]);
  for (uint32_t channel = 1; channel <= kChannels; ++channel) sendOwn(channel);
}

// A packet that the port refuses remains the next one.
void CanController::sendOwn(uint32_t channel) {
  updateState(channel);
  CanChannel& own = channels_[channel - 1];
  CanPacket packet;
  while (own.state() == BusState::Active && own.peekToSend(packet) && ports_[channel - 1]->transmit(packet)) {
    own.takeToSend(packet);
    sent_[channel - 1].pushAnyway(packet);
  }
}

void CanController::receive() {
  for (uint32_t channel = 1; channel <= kChannels; ++channel) {
    updateState(channel);
    CanPacket packet;
    while (ports_[channel - 1]->receive(packet))
      if (!takeForControl(channel, packet)) received_[channel - 1].pushAnyway(packet);
  }
}

bool CanController::takeForControl(uint32_t channel, const CanPacket& packet) {
  return channel == kDriveChannel ? drives_.take(packet) : units_.take(packet);
}

bool CanController::readItem(uint32_t channel, uint32_t group, uint32_t board, InoutsItem item, uint32_t& value) const {
  return channel == kUnitChannel && channels_[channel - 1].isActive() && units_.read(group, board, item, value);
}

bool CanController::writeItem(uint32_t channel, uint32_t group, uint32_t board, InoutsItem item, uint32_t value) {
  return channel == kUnitChannel && channels_[channel - 1].isActive() && units_.write(group, board, item, value);
}

} // namespace rung::io
