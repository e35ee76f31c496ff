// Service data objects of CANopen (CiA 301), as far as they fit packets of at most four bytes of data, with the first
// segment of an upload. Both sides use it: the control, and simulated units and drives.
#pragma once
#include "machine/io/can/packet.h"

namespace rung::io::sdo {

// Command bytes of requests and answers (spec. of CAN drives: 2Fh, 2Bh, 23h write 1, 2, 4 bytes, 40h reads).
inline constexpr uint8_t kRead = 0x40, kWritten = 0x60, kAbort = 0x80, kSegmented = 0x41, kReadSegment = 0x60;

inline constexpr uint32_t kNoSuchObject = 0x06020000, kNoSuchSubindex = 0x06090011, kWriteOnly = 0x06010001,
                          kReadOnly = 0x06010002, kNotMappable = 0x06040041, kWrongLength = 0x06070010,
                          kWrongValue = 0x06090030, kWrongState = 0x08000022, kUnknownCommand = 0x05040001;

struct Object {
  uint16_t index = 0;
  uint8_t subindex = 0;
  bool operator==(const Object&) const = default;
};

// Objects that every node has (CiA 301).
inline constexpr Object kDeviceType{0x1000, 0}, kErrorRegister{0x1001, 0}, kName{0x1008, 0},
    kHardwareVersion{0x1009, 0}, kSoftwareVersion{0x100A, 0}, kVendor{0x1018, 1};

inline uint8_t command(const CanPacket& packet) { return packet.data[0]; }
inline Object object(const CanPacket& packet) {
  return {static_cast<uint16_t>(numberAt(packet.data + 1, 2)), packet.data[3]};
}
inline uint32_t value(const CanPacket& packet) { return numberAt(packet.data + 4, 4); }

inline bool isWrite(const CanPacket& request) { return (command(request) & 0xE2) == 0x22; } // expedited
inline bool isAbort(const CanPacket& answer) { return command(answer) == kAbort; }
// Bytes of an expedited request or answer; 4 where it does not say.
inline uint32_t bytes(const CanPacket& packet) {
  return (command(packet) & 1) != 0 ? 4 - ((command(packet) >> 2) & 3) : 4;
}

// 2Fh, 2Bh, 27h, 23h for 1 to 4 bytes; with 20h more it is the answer to a reading (4Fh, 4Bh, 47h, 43h).
inline uint8_t writeCommand(uint32_t bytes) { return static_cast<uint8_t>(0x23 | (4 - bytes) << 2); }

inline CanPacket packet(uint32_t id, uint8_t command, Object object, uint32_t value) {
  CanPacket packet{.id = static_cast<uint16_t>(id), .length = 8};
  packet.data[0] = command;
  putNumber(packet.data + 1, 2, object.index);
  packet.data[3] = object.subindex;
  putNumber(packet.data + 4, 4, value);
  return packet;
}
inline CanPacket read(uint32_t node, Object object) { return packet(kSdoRequest + node, kRead, object, 0); }
inline CanPacket write(uint32_t node, Object object, uint32_t bytes, uint32_t value) {
  return packet(kSdoRequest + node, writeCommand(bytes), object, value);
}
inline CanPacket answer(uint32_t node, Object object, uint32_t bytes, uint32_t value) {
  return packet(kSdoAnswer + node, static_cast<uint8_t>(writeCommand(bytes) + 0x20), object, value);
}
inline CanPacket written(uint32_t node, Object object) { return packet(kSdoAnswer + node, kWritten, object, 0); }
inline CanPacket abort(uint32_t node, Object object, uint32_t code) {
  return packet(kSdoAnswer + node, kAbort, object, code);
}

} // namespace rung::io::sdo
