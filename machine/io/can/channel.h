// A bounded queue for use within one thread.
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

  // Returns false if the queue is full; the item is not added.
  bool push(const Item& item) {
    if (isFull()) return false;
    items_[(first_ + count_++) % N] = item;
    return true;
  }
  // Drops the oldest item if the queue is full.
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

  template <class Archive>
  void state(Archive& archive) {
    archive.atMost(count_, N);
    for (uint32_t i = 0; i < count_; ++i) archive(items_[(first_ + i) % N]);
  }

private:
  std::array<Item, N> items_{};
  uint32_t first_ = 0, count_ = 0;
};

// A CAN packet in the form that PLC programs use, TCANMSGS (man. l.9497-9511), and the identifiers of CANopen (man.
// l.3869, l.4370-4383).

inline constexpr uint16_t kCanIds = 0x800;    // identifiers have 11 bits
inline constexpr uint16_t kCanObject = 0x780; // bits of the identifier that hold the object
inline constexpr uint16_t kCanNode = 0x7F;    // bits of the identifier that hold the NODE-ID
inline constexpr uint8_t kCanDataBytes = 8;

// COB-ID = object + NODE-ID.
inline constexpr uint16_t kNodeControl = 0x000, kSync = 0x080, kEmergency = 0x080, kTpdo1 = 0x180, kRpdo1 = 0x200,
                          kTpdo2 = 0x280, kTpdo3 = 0x380, kTpdo4 = 0x480, kSdoAnswer = 0x580, kSdoRequest = 0x600,
                          kHeartbeat = 0x700; // also sent by a node once it has booted

// The twelve bytes of TCANMSGS, in this order.
struct CanPacket {
  uint16_t id = 0;    // CAN_ID, 0 to 7FFh
  uint8_t remote = 0; // CAN_RTR, not 0: requests data
  uint8_t length = 0; // CAN_LEN, bytes of `data`, 0 to 8
  uint8_t data[kCanDataBytes] = {};

  bool operator==(const CanPacket&) const = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(id, remote, length, data);
  }
  bool isObject(uint16_t object) const { return (id & kCanObject) == object; }
  uint8_t node() const { return static_cast<uint8_t>(id & kCanNode); }
  // Whether the packet was sent by the node itself, not to the node.
  bool isFromNode() const {
    const auto object = static_cast<uint16_t>(id & kCanObject);
    constexpr uint16_t kObjects[] = {kEmergency, kTpdo1, kTpdo2, kTpdo3, kTpdo4, kSdoAnswer, kHeartbeat};
    return remote == 0 && node() != 0 &&
           std::find(std::begin(kObjects), std::end(kObjects), object) != std::end(kObjects);
  }
};
static_assert(sizeof(CanPacket) == 12);

// The packet as the bus carries it: bits and bytes that a frame cannot hold are removed, unused bytes are 0.
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

// Network management commands (CiA 301) to one node or to all: start the exchange of process data, or leave it.
inline constexpr uint8_t kStartNode = 0x01, kPrepareNode = 0x80, kAllNodes = 0;
inline CanPacket nodeCommand(uint8_t command, uint32_t node) {
  return packetOf(kNodeControl, {command, static_cast<uint8_t>(node)});
}
inline bool isNodeCommandFor(const CanPacket& packet, uint32_t node) {
  return packet.id == kNodeControl && (packet.data[1] == kAllNodes || packet.data[1] == node);
}

// Numbers in packets and in structures of the control: low byte first.
inline uint32_t numberAt(const uint8_t* bytes, uint32_t width) {
  uint32_t value = 0;
  for (uint32_t i = 0; i < width; ++i) value |= uint32_t{bytes[i]} << 8 * i;
  return value;
}
inline void putNumber(uint8_t* bytes, uint32_t width, uint32_t value) {
  for (uint32_t i = 0; i < width; ++i) bytes[i] = static_cast<uint8_t>(value >> 8 * i);
}

// The packet subscriptions that a PLC program has made with CAN_RECV_REQ (man. l.3784-3845). Each has a procedure and a
// buffer, which the caller keeps; here a subscription is a number, its handle.

inline constexpr uint32_t kMostCanOrders = 32;

// The limits of the ranges are inclusive (man. l.3811-3831).
struct CanOrder {
  uint32_t channel = 0;                   // 1, 2
  uint32_t objectLow = 0, objectHigh = 0; // of (identifier & 780h): 0 to 7FFh
  uint32_t nodeLow = 0, nodeHigh = 0;     // of (identifier & 7Fh): 0 to 7Fh

  template <class Archive>
  void state(Archive& archive) {
    archive(channel, objectLow, objectHigh, nodeLow, nodeHigh);
  }
};

// The handles of subscriptions that match a packet, lowest first.
struct CanMatches {
  std::array<uint32_t, kMostCanOrders> handles{};
  uint32_t count = 0;

  std::span<const uint32_t> all() const { return {handles.data(), count}; }
};

// The subscriptions of all channels together: CAN_RECV_DEL does not name a channel.
class CanOrders {
public:
  // Returns the handle, which increases from 1; 0: refused, because a range is empty or out of its limits, or there are
  // already 32 subscriptions.
  uint32_t add(const CanOrder& order);
  // Returns false if there is no such handle.
  bool remove(uint32_t handle);
  // At START PLC: deletes all subscriptions; handles start again.
  void clear();

  uint32_t count() const { return count_; }
  CanMatches matching(uint32_t channel, const CanPacket& packet) const;

  template <class Archive>
  void state(Archive& archive) {
    archive(lastHandle_);
    archive.atMost(count_, kMostCanOrders);
    for (uint32_t i = 0; i < count_; ++i) archive(entries_[i]);
  }

private:
  struct Entry {
    uint32_t handle = 0;
    CanOrder order;
    template <class Archive>
    void state(Archive& archive) {
      archive(handle, order);
    }
  };
  std::array<Entry, kMostCanOrders> entries_; // sorted by handle
  uint32_t count_ = 0;
  uint32_t lastHandle_ = 0;
};

// A logical CAN channel as a PLC program sees it (man. l.3689-3860): its transmit queue, its receive queue, its
// subscriptions. A CanPort, for a simulated bus or a real one, moves the packets. Everything runs on the scan thread.

enum class BusState : uint8_t {
  Inactive, // the channel is not configured
  Active,
  BusOff, // the controller has left the bus after too many errors
  Down,   // the interface does not exist, or is down
};

// Values of DR after CAN_SEND and CAN_RECV (man. l.3708-3717).
enum class CanError : uint8_t { Ok = 0, SendQueueFull = 1, NothingReceived = 2 };

class CanChannel {
public:
  static constexpr uint32_t kQueue = 32;

  // `number` is 1 or 2; `orders` must outlive the channel.
  CanChannel(uint32_t number, CanOrders& orders) : number_(number), orders_(orders) {}

  uint32_t number() const { return number_; }
  BusState state() const { return state_; }
  void setState(BusState state) { state_ = state; }
  bool isActive() const { return state_ != BusState::Inactive; }
  // At a power-on: empties the queues.
  void reset();

  // ---- the program's instructions

  // CAN_SEND. SendQueueFull: the queue is full, or the channel is not active or off the bus.
  CanError send(const CanPacket& packet);
  // CAN_RECV. `packet` stays unchanged if no packet was received.
  CanError receive(CanPacket& packet);
  // CAN_RECV_REQ; `order.channel` is set here. Returns 0 if refused.
  uint32_t order(CanOrder order);

  // ---- the bus

  // The oldest packet to be transmitted.
  bool takeToSend(CanPacket& packet) { return toSend_.pop(packet); }
  bool peekToSend(CanPacket& packet) const { return toSend_.peek(packet); }
  // Delivers a received packet. Returns the matching subscriptions; without one the packet waits for CAN_RECV; of more
  // than 32, the oldest is lost.
  CanMatches deliver(const CanPacket& packet);

  template <class Archive>
  void state(Archive& archive) {
    archive(state_, toSend_, received_);
  }

private:
  uint32_t number_;
  CanOrders& orders_;
  BusState state_ = BusState::Inactive;
  BoundedQueue<CanPacket, kQueue> toSend_, received_;
};

// The connection of a logical channel: a simulated bus or an interface of the machine.

// Called by the scan thread; nothing waits.
class CanPort {
public:
  virtual ~CanPort() = default;
  virtual BusState state() const = 0;
  // Returns false if there is no room, or the bus accepts nothing.
  virtual bool transmit(const CanPacket& packet) = 0;
  // Takes the oldest received packet; returns false if there is none.
  virtual bool receive(CanPacket& packet) = 0;
};

} // namespace rung::io
