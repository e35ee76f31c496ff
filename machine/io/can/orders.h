// The packets that a PLC program has ordered by CAN_RECV_REQ (man. l.3784-3845): each order has a procedure and a
// buffer, which are the caller's; here it is a number, the handle.
#pragma once
#include <array>
#include <span>

#include "machine/io/can/packet.h"

namespace rung::io {

inline constexpr uint32_t kMostCanOrders = 32;

// Both ends of the ranges belong to them (man. l.3811-3831).
struct CanOrder {
  uint32_t channel = 0;                   // 1, 2
  uint32_t objectLow = 0, objectHigh = 0; // of (identifier & 780h): 0 to 7FFh
  uint32_t nodeLow = 0, nodeHigh = 0;     // of (identifier & 7Fh): 0 to 7Fh
};

// The handles of orders that match a packet, lowest first.
struct CanMatches {
  std::array<uint32_t, kMostCanOrders> handles{};
  uint32_t count = 0;

  std::span<const uint32_t> all() const { return {handles.data(), count}; }
};

// Of all channels together: CAN_RECV_DEL names no channel.
class CanOrders {
public:
  // The handle, which grows from 1; 0: refused, for a range is empty or beyond its limits, or there are 32 orders.
  uint32_t add(const CanOrder& order);
  // False: there is no such order.
  bool remove(uint32_t handle);
  // At START PLC. Handles begin again.
  void clear();

  uint32_t count() const { return count_; }
  CanMatches matching(uint32_t channel, const CanPacket& packet) const;

private:
  struct Entry {
    uint32_t handle = 0;
    CanOrder order;
  };
  std::array<Entry, kMostCanOrders> entries_; // by handle
  uint32_t count_ = 0;
  uint32_t lastHandle_ = 0;
};

} // namespace rung::io
