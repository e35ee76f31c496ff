// A bounded queue of packets within one thread.
#pragma once
#include <array>

#include "tools/devices/can/packet.h"

namespace rung::devices {

template <uint32_t N>
class PacketQueue {
public:
  bool isFull() const { return count_ == N; }
  uint32_t size() const { return count_; }
  void clear() { count_ = 0; }

  // False: full, the packet is not taken.
  bool push(const CanPacket& packet) {
    if (isFull()) return false;
    items_[(first_ + count_++) % N] = packet;
    return true;
  }
  // The oldest one makes room for it.
  void pushAnyway(const CanPacket& packet) {
    CanPacket oldest;
    if (isFull()) pop(oldest);
    push(packet);
  }
  bool peek(CanPacket& packet) const {
    if (count_ > 0) packet = items_[first_];
    return count_ > 0;
  }
  bool pop(CanPacket& packet) {
    if (!peek(packet)) return false;
    first_ = (first_ + 1) % N;
    --count_;
    return true;
  }

private:
  std::array<CanPacket, N> items_;
  uint32_t first_ = 0, count_ = 0;
};

} // namespace rung::devices
