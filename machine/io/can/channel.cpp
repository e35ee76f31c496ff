// A logical channel.
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

// Packet subscriptions.

namespace {

bool isRange(uint32_t low, uint32_t high, uint32_t most) { return low <= high && high <= most; }
bool isWithin(uint32_t value, uint32_t low, uint32_t high) { return value >= low && value <= high; }

bool matches(const CanOrder& order, uint32_t channel, const CanPacket& packet) {
  return order.channel == channel && isWithin(packet.id & kCanObject, order.objectLow, order.objectHigh) &&
         isWithin(packet.id & kCanNode, order.nodeLow, order.nodeHigh);
}

} // namespace

uint32_t CanOrders::add(const CanOrder& order) {
  if (count_ == kMostCanOrders || lastHandle_ == UINT32_MAX) return 0;
  if (!isRange(order.objectLow, order.objectHigh, kCanIds - 1)) return 0;
  if (!isRange(order.nodeLow, order.nodeHigh, kCanNode)) return 0;
  entries_[count_++] = {++lastHandle_, order};
  return lastHandle_;
}

bool CanOrders::remove(uint32_t handle) {
  const auto end = entries_.begin() + count_;
  const auto found = std::find_if(entries_.begin(), end, [&](const Entry& entry) { return entry.handle == handle; });
  if (found == end) return false;
  std::copy(found + 1, end, found);
  --count_;
  return true;
}

void CanOrders::clear() { count_ = lastHandle_ = 0; }

CanMatches CanOrders::matching(uint32_t channel, const CanPacket& packet) const {
  CanMatches found;
  for (const Entry& entry : std::span(entries_).first(count_))
    if (matches(entry.order, channel, packet)) found.handles[found.count++] = entry.handle;
  return found;
}

} // namespace rung::io
