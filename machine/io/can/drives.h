// The control's side of the drives on CAN channel 1 (man. 13.14): command words go to them and status words come from
// them with each SYNC, CAN_AX_SEND asks one by SDO, emergency packets become messages of the control.
//
// RPDO1 is the control word of CiA 402, of a Unidrive CAN_DRIVE_CMD; TPDO1 is the status word and CAN_DRIVE_MSTAT.
#pragma once
#include <array>
#include <string>

#include "machine/io/can/port.h"
#include "machine/io/can/sdo.h"

namespace rung::io {

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
  std::array<uint16_t, kMostDrives> status{};       // CAN_DRIVE_STAT; 0: no drive, or one that does not answer
  std::array<uint16_t, kMostDrives> manufacturer{}; // CAN_DRIVE_MSTAT
};

// A message of the control about a drive (man. l.9627-9653).
struct DriveMessage {
  static constexpr uint16_t kEmergency = 4217, kTimeout = 4219;
  uint16_t number = 0;    // 4217: emergency; 4219: the drive is silent
  uint16_t drive = 0;     // from 1
  uint16_t fault = 0;     // row of the list of emergencies (man. l.9656 ...), 0: not in it
  uint16_t emergency = 0; // error code of CiA 301

  bool operator==(const DriveMessage&) const = default;
};

// As the log has it.
std::string textOf(const DriveMessage& message);

class CanDrives {
public:
  // Before the first tick. Drives have the nodes 1 to `drives`, which are the axes' numbers (man. l.9203).
  void configure(uint32_t drives) { count_ = drives; }
  void setType(uint32_t drive, DriveType type) { drives_[drive - 1].type = type; }
  void setSyncPeriod(uint32_t ms) { syncPeriod_ = ms; }
  uint32_t count() const { return count_; }

  void reset();
  void tick(const DriveOrders& orders, DriveStates& states, CanPort& port);
  // A packet has come. True: the control alone was meant.
  bool take(const CanPacket& packet);
  // The oldest message that nobody took; of more than 16 the newest are lost.
  bool takeMessage(DriveMessage& message) { return messages_.pop(message); }

  // CAN_AX_SEND: fills in what the program leaves open of CAN_AX_SEND_PACKET and sends it (man. l.9480-9493).
  void send(uint32_t axis, CanPacket& packet);
  // CAN_AX_BUSY, CAN_AX_RECV_PACKET.
  uint8_t busy() const { return waitsFor_ != 0 ? 0xFF : 0; }
  const CanPacket& answer() const { return answer_; }

private:
  struct Drive {
    DriveType type = DriveType::Kollmorgen;
    uint16_t status = 0, manufacturer = 0;
    bool mustRelease = false; // after a fault: enabled again when the program has taken the command back
    uint32_t silentMs = 0;
  };
  static uint16_t controlWord(Drive& drive, uint16_t command);
  void watch(uint32_t number, CanPort& port);

  std::array<Drive, kMostDrives> drives_{};
  uint32_t count_ = 0;
  uint32_t syncPeriod_ = 1, sinceSync_ = 0;
  bool started_ = false;

  uint32_t waitsFor_ = 0; // node, 0: nobody
  bool isToSend_ = false;
  CanPacket question_, answer_;

  BoundedQueue<DriveMessage, 16> messages_;
};

} // namespace rung::io
