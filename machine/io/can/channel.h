// A bounded queue within one thread.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <span>

namespace rung::io {

template <class Item, uint32_t N>
class BoundedQueue {
public:
  bool isFull() const { return count_ == N; }
  uint32_t size() const { return count_; }
  void clear() { count_ = 0; }

  // False: full, the item is not taken.
  bool push(const Item& item) {
    if (isFull()) return false;
    items_[(first_ + count_++) % N] = item;
    return true;
  }
  // The oldest one makes room for it.
  void pushAnyway(const Item& item) {
    Item oldest;
    if (isFull()) pop(oldest);
    push(item);
  }
  bool peek(Item& item) const {
    if (count_ > 0) item = items_[first_];
    return count_ > 0;
  }
  bool pop(Item& item) {
    if (!peek(item)) return false;
    first_ = (first_ + 1) % N;
    --count_;
    return true;
  }

private:
  std::array<Item, N> items_{};
  uint32_t first_ = 0, count_ = 0;
};

// A packet of the CAN bus in the form that PLC programs know, TCANMSGS (man. l.9497-9511), and the identifiers that
// CANopen gives it (man. l.3869, l.4370-4383).

inline constexpr uint16_t kCanIds = 0x800;    // identifiers have 11 bits
inline constexpr uint16_t kCanObject = 0x780; // bits of the identifier that are the object
inline constexpr uint16_t kCanNode = 0x7F;    // and those that are the NODE-ID
inline constexpr uint8_t kCanDataBytes = 8;

// COB-ID = object + NODE-ID.
inline constexpr uint16_t kNodeControl = 0x000, kSync = 0x080, kEmergency = 0x080, kTpdo1 = 0x180, kRpdo1 = 0x200,
                          kTpdo2 = 0x280, kTpdo3 = 0x380, kTpdo4 = 0x480, kSdoAnswer = 0x580, kSdoRequest = 0x600,
                          kHeartbeat = 0x700; // and what a node sends once it has booted

// The twelve bytes of TCANMSGS, in its order.
struct CanPacket {
  uint16_t id = 0;    // CAN_ID, 0 to 7FFh
  uint8_t remote = 0; // CAN_RTR, not 0: asks for data
  uint8_t length = 0; // CAN_LEN, bytes of `data`, 0 to 8
  uint8_t data[kCanDataBytes] = {};

  bool operator==(const CanPacket&) const = default;
  bool isObject(uint16_t object) const { return (id & kCanObject) == object; }
  uint8_t node() const { return static_cast<uint8_t>(id & kCanNode); }
  // The node itself has sent the packet; it was not sent to the node.
  bool isFromNode() const {
    const auto object = static_cast<uint16_t>(id & kCanObject);
    constexpr uint16_t kObjects[] = {kEmergency, kTpdo1, kTpdo2, kTpdo3, kTpdo4, kSdoAnswer, kHeartbeat};
    return remote == 0 && node() != 0 &&
           std::find(std::begin(kObjects), std::end(kObjects), object) != std::end(kObjects);
  }
};
static_assert(sizeof(CanPacket) == 12);

// As it is on the bus: bits and bytes that it cannot hold are taken away, bytes that are not used are 0.
inline CanPacket onBus(CanPacket packet) {
  packet.id &= kCanIds - 1;
  packet.remote = packet.remote != 0 ? 1 : 0;
  packet.length = std::min(packet.length, kCanDataBytes);
  std::fill(packet.data + (packet.remote != 0 ? 0 : packet.length), packet.data + kCanDataBytes, uint8_t{0});
  return packet;
}

inline CanPacket packetOf(uint32_t id, std::initializer_list<uint8_t> data) {
  CanPacket packet{.id = static_cast<uint16_t>(id), .length = static_cast<uint8_t>(data.size())};
  std::copy(data.begin(), data.end(), packet.data);
  return packet;
}

// Commands of network management (CiA 301) to a node, or to all of them: it takes part in the exchange of process data,
// or leaves it.
inline constexpr uint8_t kStartNode = 0x01, kPrepareNode = 0x80, kAllNodes = 0;
inline CanPacket nodeCommand(uint8_t command, uint32_t node) {
  return packetOf(kNodeControl, {command, static_cast<uint8_t>(node)});
}
inline bool isNodeCommandFor(const CanPacket& packet, uint32_t node) {
  return packet.id == kNodeControl && (packet.data[1] == kAllNodes || packet.data[1] == node);
}

// Numbers in packets and in structures of the control: the low byte comes first.
inline uint32_t numberAt(const uint8_t* bytes, uint32_t width) {
  uint32_t value = 0;
  for (uint32_t i = 0; i < width; ++i) value |= uint32_t{bytes[i]} << 8 * i;
  return value;
}
inline void putNumber(uint8_t* bytes, uint32_t width, uint32_t value) {
  for (uint32_t i = 0; i < width; ++i) bytes[i] = static_cast<uint8_t>(value >> 8 * i);
}

// The packets that a PLC program has ordered by CAN_RECV_REQ (man. l.3784-3845): each order has a procedure and a
// buffer, which are the caller's; here it is a number, the handle.

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

// A logical CAN channel as a PLC program sees it (man. l.3689-3860): the queue of what it sends, the queue of what it
// receives, its orders. What moves the packets, a simulated bus or a real one, is a CanPort (port.h). All of it runs on
// the scan's thread.

enum class BusState : uint8_t {
  Inactive, // the configuration has no such channel
  Active,
  BusOff, // the controller has left the bus after too many errors
  Down,   // the interface is not there, or is switched off
};

// The values of DR after CAN_SEND and CAN_RECV (man. l.3708-3717).
enum class CanError : uint8_t { Ok = 0, SendQueueFull = 1, NothingReceived = 2 };

class CanChannel {
public:
  static constexpr uint32_t kQueue = 32;

  // `number` is 1 or 2; `orders` outlives the channel.
  CanChannel(uint32_t number, CanOrders& orders) : number_(number), orders_(orders) {}

  uint32_t number() const { return number_; }
  BusState state() const { return state_; }
  void setState(BusState state) { state_ = state; }
  bool isActive() const { return state_ != BusState::Inactive; }
  // At a power-on: the queues are empty.
  void reset();

  // ---- the program's instructions

  // CAN_SEND. The queue is full; or the channel is not active, or off the bus.
  CanError send(const CanPacket& packet);
  // CAN_RECV. `packet` stays where nothing has come.
  CanError receive(CanPacket& packet);
  // CAN_RECV_REQ; `order.channel` is set here. 0: refused.
  uint32_t order(CanOrder order);

  // ---- the bus

  // The oldest packet that the program sends.
  bool takeToSend(CanPacket& packet) { return toSend_.pop(packet); }
  bool peekToSend(CanPacket& packet) const { return toSend_.peek(packet); }
  // A packet has come. The orders that it fills; without one it waits for CAN_RECV, and of more than 32 the oldest is
  // lost.
  CanMatches deliver(const CanPacket& packet);

private:
  uint32_t number_;
  CanOrders& orders_;
  BusState state_ = BusState::Inactive;
  BoundedQueue<CanPacket, kQueue> toSend_, received_;
};

// What a logical channel is connected to: a simulated bus or an interface of the machine.

// Called by the scan's thread: nothing waits.
class CanPort {
public:
  virtual ~CanPort() = default;
  virtual BusState state() const = 0;
  // False: there is no room, or the bus takes nothing.
  virtual bool transmit(const CanPacket& packet) = 0;
  // The oldest packet that has come; false: none.
  virtual bool receive(CanPacket& packet) = 0;
};

} // namespace rung::io
