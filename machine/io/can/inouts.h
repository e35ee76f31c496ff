// The structure INOUTS, of which the control has one for each of its units (man. l.4074-4185): bytes in the order of
// the signals' table, without gaps. Programs read and write its items by CAN_SYSIO_READ and CAN_SYSIO_WRITE.
#pragma once
#include <array>

#include "machine/io/can/packet.h"

namespace rung::io {

struct InoutsItem {
  uint32_t offset = 0, bytes = 1;
};

namespace inouts {
inline constexpr InoutsItem kSize{0, 2}, kPresent{2}, kMode{3}, kVendor{4, 4}, kDeviceName{8, 4},
    kHardwareVersion{12, 4}, kSoftwareVersion{16, 4};
inline constexpr uint32_t kIn = 20, kOut = 24, kAnalogue = 27; // IN0-IN3, OUT0-OUT2, ANL0-ANL7
inline constexpr InoutsItem kError{35}, kErrorCode{36}, kErrorStatus{37}, kControl{38}, kCount{39, 2}, kSendRequest{41},
    kAnswerCount{42}, kShortRequest{43};
inline constexpr uint32_t kShort = 44, kSend = 47, kAnswer = 59; // SHORT_OUT0-SHORT_OUT2, packets SEND, RESP
inline constexpr InoutsItem kRpdoCount{71, 2}, kTpdoCount{73, 2}, kFirstIn{75, 2}, kFirstOut{77, 2}, kModeNow{79},
    kModePhase{80};
inline constexpr uint32_t kKeys = 81, kEncoder = 85; // TL0-TL3, IRC0, IRC1
inline constexpr uint32_t kBytes = 109;              // with five pointers, which are the control's own
} // namespace inouts

// MODE (man. l.4078).
inline constexpr uint8_t kModeStandard = 0, kModeAnalogue = 1, kModeMatrix = 2;
// ERROR, the error register 1001h (man. l.3655-3668).
inline constexpr uint8_t kErrorAny = 0x01, kErrorShort = 0x02, kErrorSupply = 0x04, kErrorTemperature = 0x08,
                         kErrorCommunication = 0x10, kErrorInput = 0x80;
// ERR_STAT (man. l.4252-4263).
inline constexpr uint8_t kErrorNow = 0x01, kTimeoutNow = 0x02, kErrorMemory = 0x04, kTimeoutMemory = 0x08,
                         kZeroAll = 0x10;
// CONTROL (man. l.3520-3542).
inline constexpr uint8_t kHideErrors = 0x01, kNoShortReports = 0x02, kNoTimeout = 0x04, kNoZeroing = 0x40;

class Inouts {
public:
  uint32_t get(InoutsItem item) const { return numberAt(bytes_.data() + item.offset, item.bytes); }
  void set(InoutsItem item, uint32_t value) { putNumber(bytes_.data() + item.offset, item.bytes, value); }
  void count(InoutsItem item) { set(item, get(item) + 1); }
  uint8_t& at(uint32_t offset) { return bytes_[offset]; }
  const uint8_t& at(uint32_t offset) const { return bytes_[offset]; }

private:
  std::array<uint8_t, inouts::kBytes> bytes_{};
};

} // namespace rung::io
