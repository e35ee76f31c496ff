// A logical channel (see channel.h).
#include "machine/io/can/channel.h"

namespace rung::io {

void CanChannel::reset() {
  toSend_.clear();
  received_.clear();
}

CanError CanChannel::send(const CanPacket& packet) {
  const bool taken = state_ == BusState::Active && toSend_.push(onBus(packet));
  return taken ? CanError::Ok : CanError::SendQueueFull;
}

CanError CanChannel::receive(CanPacket& packet) {
  return received_.pop(packet) ? CanError::Ok : CanError::NothingReceived;
}

uint32_t CanChannel::order(CanOrder order) {
  order.channel = number_;
  return isActive() ? orders_.add(order) : 0;
}

CanMatches CanChannel::deliver(const CanPacket& packet) {
  if (!isActive()) return {};
  const CanPacket clean = onBus(packet);
  const CanMatches matches = orders_.matching(number_, clean);
  if (matches.count == 0) received_.pushAnyway(clean);
  return matches;
}

} // namespace rung::io
