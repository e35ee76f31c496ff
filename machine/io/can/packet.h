// A packet of the CAN bus in the form that PLC programs know, TCANMSGS (man. l.9497-9511), and the identifiers that
// CANopen gives it (man. l.3869, l.4370-4383).
#pragma once
#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <iterator>

namespace rung::io {

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
  // The node itself has sent it, not somebody to it.
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

} // namespace rung::io
