// CANopen service data objects (CiA 301) that fit packets of at most four data bytes, and the first segment of an
// upload. Used by both sides: the control, and simulated units and drives.
#pragma once
#include <array>
#include <string>

#include "machine/io/can/channel.h"

namespace rung::io {

namespace sdo {

// Command bytes of requests and answers (spec. of CAN drives: 2Fh, 2Bh, 23h write 1, 2, 4 bytes, 40h reads).
inline constexpr uint8_t kRead = 0x40, kWritten = 0x60, kAbort = 0x80, kSegmented = 0x41, kReadSegment = 0x60;

inline constexpr uint32_t kNoSuchObject = 0x06020000, kNoSuchSubindex = 0x06090011, kWriteOnly = 0x06010001,
                          kReadOnly = 0x06010002, kNotMappable = 0x06040041, kWrongLength = 0x06070010,
                          kWrongValue = 0x06090030, kWrongState = 0x08000022, kUnknownCommand = 0x05040001;

struct Object {
  uint16_t index = 0;
  uint8_t subindex = 0;
  bool operator==(const Object&) const = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(index, subindex);
  }
};

// Objects of every node (CiA 301).
inline constexpr Object kDeviceType{0x1000, 0}, kErrorRegister{0x1001, 0}, kName{0x1008, 0},
    kHardwareVersion{0x1009, 0}, kSoftwareVersion{0x100A, 0}, kVendor{0x1018, 1};

inline uint8_t command(const CanPacket& packet) { return packet.data[0]; }
inline Object object(const CanPacket& packet) {
  return {static_cast<uint16_t>(numberAt(packet.data + 1, 2)), packet.data[3]};
}
inline uint32_t value(const CanPacket& packet) { return numberAt(packet.data + 4, 4); }

inline bool isWrite(const CanPacket& request) { return (command(request) & 0xE2) == 0x22; } // expedited
inline bool isAbort(const CanPacket& answer) { return command(answer) == kAbort; }
// Data bytes of an expedited request or answer; 4 if the size is not indicated.
inline uint32_t bytes(const CanPacket& packet) {
  return (command(packet) & 1) != 0 ? 4 - ((command(packet) >> 2) & 3) : 4;
}

// 2Fh, 2Bh, 27h, 23h for 1 to 4 bytes; plus 20h, it is the answer to a read request (4Fh, 4Bh, 47h, 43h).
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

} // namespace sdo

// The control's side of the drives on CAN channel 1 (man. 13.14): exchanges command and status words with each SYNC,
// sends the SDO requests of CAN_AX_SEND, and turns emergency packets into messages of the control.
//
// RPDO1 is the control word of CiA 402, for a Unidrive CAN_DRIVE_CMD; TPDO1 is the status word and CAN_DRIVE_MSTAT.

inline constexpr uint32_t kMostDrives = 16;
inline constexpr uint32_t kDriveTimeoutMs = 100;

enum class DriveType : uint8_t { Kollmorgen, Unidrive };

// CAN_DRIVE_CMD (man. l.9372-9384, l.9409-9441).
inline constexpr uint16_t kDriveEnable = 0x0001, kDriveBrake = 0x0002; // Kollmorgen, Berger-Lahr
// CAN_DRIVE_STAT (man. l.9324-9339).
inline constexpr uint16_t kDriveReady = 0x01, kDriveOn = 0x02, kDriveEnabled = 0x04, kDriveFault = 0x08,
                          kDriveVoltage = 0x10, kDriveNoQuickStop = 0x20, kDriveBraked = 0x40, kDriveWarning = 0x80;

struct DriveOrders {
  std::array<uint16_t, kMostDrives> command{}; // CAN_DRIVE_CMD
};

struct DriveStates {
  std::array<uint16_t, kMostDrives> status{};       // CAN_DRIVE_STAT; 0: no drive, or it does not answer
  std::array<uint16_t, kMostDrives> manufacturer{}; // CAN_DRIVE_MSTAT

  template <class Archive>
  void state(Archive& archive) {
    archive(status, manufacturer);
  }
};

// A message of the control about a drive (man. l.9627-9653).
struct DriveMessage {
  static constexpr uint16_t kEmergency = 4217, kTimeout = 4219;
  uint16_t number = 0;    // 4217: emergency; 4219: the drive does not answer
  uint16_t drive = 0;     // from 1
  uint16_t fault = 0;     // row in the list of emergencies (man. l.9656 ...), 0: not listed
  uint16_t emergency = 0; // error code of CiA 301

  bool operator==(const DriveMessage&) const = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(number, drive, fault, emergency);
  }
};

// The sentence for the log.
std::string textOf(const DriveMessage& message);

class CanDrives {
public:
  // To be called before the first tick. Drives have the nodes 1 to `drives`, which are the axis numbers (man. l.9203).
  void configure(uint32_t drives) { count_ = drives; }
  void setType(uint32_t drive, DriveType type) { drives_[drive - 1].type = type; }
  void setSyncPeriod(uint32_t ms) { syncPeriod_ = ms; }
  uint32_t count() const { return count_; }

  void reset();
  void tick(const DriveOrders& orders, DriveStates& states, CanPort& port);
  // Processes a received packet. Returns true if the packet is only for the control.
  bool take(const CanPacket& packet);
  // The oldest message not yet taken; of more than 16, the newest are lost.
  bool takeMessage(DriveMessage& message) { return messages_.pop(message); }

  // CAN_AX_SEND: completes CAN_AX_SEND_PACKET and sends it (man. l.9480-9493).
  void send(uint32_t axis, CanPacket& packet);
  // CAN_AX_BUSY, CAN_AX_RECV_PACKET.
  uint8_t busy() const { return waitsFor_ != 0 ? 0xFF : 0; }
  const CanPacket& answer() const { return answer_; }

  template <class Archive>
  void state(Archive& archive) {
    archive(drives_, sinceSync_, started_, waitsFor_, isToSend_, question_, answer_, messages_);
  }

private:
  struct Drive {
    DriveType type = DriveType::Kollmorgen;
    uint16_t status = 0, manufacturer = 0;
    bool mustRelease = false; // after a fault: enabled again only when the program has withdrawn the command
    uint32_t silentMs = 0;
    template <class Archive>
    void state(Archive& archive) {
      archive(status, manufacturer, mustRelease, silentMs);
    }
  };
  static uint16_t controlWord(Drive& drive, uint16_t command);
  void watch(uint32_t number, CanPort& port);

  std::array<Drive, kMostDrives> drives_{};
  uint32_t count_ = 0;
  uint32_t syncPeriod_ = 1, sinceSync_ = 0;
  bool started_ = false;

  uint32_t waitsFor_ = 0; // node whose answer is awaited; 0: none
  bool isToSend_ = false;
  CanPacket question_, answer_;

  BoundedQueue<DriveMessage, 16> messages_;
};

// The structure INOUTS, one for each unit of the control (man. l.4074-4185): bytes in the order of the table of
// signals, without gaps. Programs read and write its items with CAN_SYSIO_READ and CAN_SYSIO_WRITE.

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
inline constexpr uint32_t kBytes = 109;              // including five pointers that only the control uses
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

  template <class Archive>
  void state(Archive& archive) {
    archive(bytes_);
  }

private:
  std::array<uint8_t, inouts::kBytes> bytes_{};
};

} // namespace rung::io
