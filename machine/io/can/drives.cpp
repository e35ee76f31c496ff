// The drives as seen by the control.
#include "machine/io/can/drives.h"

#include "rtlib/text/hex.h"

namespace rung::io {

namespace {

// Control words and states of CiA 402.
constexpr uint16_t kDisableVoltage = 0x00, kShutdown = 0x06, kSwitchOn = 0x07, kEnableOperation = 0x0F;
constexpr uint16_t kStateBits = 0x4F, kSwitchOnDisabled = 0x40;

constexpr uint8_t kStatusBytes = 4; // bytes used in TPDO1
constexpr uint8_t kCodeBytes = 2;   // bytes of an emergency

// Emergencies of the ServoStar in the order of the manual's list, whose numbers begin with 1 (l.9656-9740).
constexpr uint16_t kEmergencies[] = {0x1000, 0x1080, 0x2330, 0x3100, 0x3110, 0x3120, 0x3130, 0x4110, 0x4210, 0x4310,
                                     0x5111, 0x5380, 0x5400, 0x5420, 0x5441, 0x5530, 0x5581, 0x6010, 0x6181, 0x6182,
                                     0x6183, 0x6184, 0x6185, 0x6281, 0x6282, 0x6320, 0x7111, 0x7122, 0x7181, 0x7182,
                                     0x7303, 0x8053, 0x8181, 0x8182, 0x8281, 0x8282, 0x8331, 0x8480, 0x8611, 0x8681,
                                     0x8682, 0xFF01, 0xFF02, 0xFF03, 0xFF04, 0xFF06};

uint16_t faultOf(uint16_t emergency) {
  const auto* const found = std::find(std::begin(kEmergencies), std::end(kEmergencies), emergency);
  return found == std::end(kEmergencies) ? 0 : static_cast<uint16_t>(found - kEmergencies + 1);
}

} // namespace

std::string textOf(const DriveMessage& message) {
  const std::string number = std::to_string(message.number), drive = std::to_string(message.drive);
  if (message.number == DriveMessage::kTimeout) return number + ": time-out of drive " + drive;
  return number + ": emergency of drive " + drive + ", fault " + std::to_string(message.fault) + ", emergency " +
         text::hexOfNumber(message.emergency, 2);
}

void CanDrives::reset() {
  for (Drive& drive : drives_) drive = {.type = drive.type};
  sinceSync_ = waitsFor_ = 0;
  started_ = isToSend_ = false;
  question_ = answer_ = {};
  messages_.clear();
}

// Brake has priority over enable (man. l.9377-9384); without both, the drive is on without torque. The intermediate
// states are passed one by one. Bit 7, which would reset a fault, is left to the program (CAN_AX_SEND).
uint16_t CanDrives::controlWord(Drive& drive, uint16_t command) {
  if (drive.type == DriveType::Unidrive) return command;
  if ((drive.status & kDriveFault) != 0)
    drive.mustRelease = true;
  else if ((command & kDriveEnable) == 0)
    drive.mustRelease = false;
  if ((command & kDriveBrake) != 0 || (drive.status & kDriveFault) != 0) return kDisableVoltage;
  if ((drive.status & kStateBits) == kSwitchOnDisabled) return kShutdown;
  const bool isOn = (drive.status & kDriveOn) != 0;
  const bool enable = (command & kDriveEnable) != 0 && !drive.mustRelease;
  return isOn && enable ? kEnableOperation : kSwitchOn;
}

void CanDrives::tick(const DriveOrders& orders, DriveStates& states, CanPort& port) {
  if (isToSend_) port.transmit(question_); // not repeated if the bus does not accept it now
  isToSend_ = false;
  if (count_ == 0) return;
  if (!started_) started_ = port.transmit(nodeCommand(kStartNode, kAllNodes));
  for (uint32_t i = 0; i < count_; ++i) watch(i + 1, port);
  if (++sinceSync_ >= syncPeriod_) {
    sinceSync_ = 0;
    for (uint32_t i = 0; i < count_; ++i) {
      const uint16_t word = controlWord(drives_[i], orders.command[i]);
      port.transmit(packetOf(kRpdo1 + i + 1, {static_cast<uint8_t>(word), static_cast<uint8_t>(word >> 8)}));
    }
    port.transmit(packetOf(kSync, {}));
  }
  for (uint32_t i = 0; i < count_; ++i) {
    states.status[i] = drives_[i].status;
    states.manufacturer[i] = drives_[i].manufacturer;
  }
}

// For the program, a drive that does not answer is neither enabled nor braked.
void CanDrives::watch(uint32_t number, CanPort& port) {
  Drive& drive = drives_[number - 1];
  if (++drive.silentMs % kDriveTimeoutMs != 0) return;
  port.transmit(nodeCommand(kStartNode, number));
  if (drive.silentMs == kDriveTimeoutMs)
    messages_.push({.number = DriveMessage::kTimeout, .drive = static_cast<uint16_t>(number)});
  drive.status = drive.manufacturer = 0;
  drive.mustRelease = true;
}

bool CanDrives::take(const CanPacket& packet) {
  const uint32_t node = packet.node();
  const bool isAnswer = node != 0 && node == waitsFor_ && packet.isObject(kSdoAnswer);
  if (isAnswer) {
    answer_ = packet;
    waitsFor_ = 0;
  }
  if (node == 0 || node > count_ || !packet.isFromNode()) return isAnswer;
  Drive& drive = drives_[node - 1];
  drive.silentMs = 0;
  if (packet.isObject(kTpdo1)) {
    if (packet.length < kStatusBytes) return true; // without content
    drive.status = static_cast<uint16_t>(numberAt(packet.data, 2));
    drive.manufacturer = static_cast<uint16_t>(numberAt(packet.data + 2, 2));
    return true;
  }
  const auto emergency = static_cast<uint16_t>(numberAt(packet.data, 2));
  if (packet.isObject(kEmergency) && packet.length >= kCodeBytes && emergency != 0)
    messages_.push({DriveMessage::kEmergency, static_cast<uint16_t>(node), faultOf(emergency), emergency});
  return isAnswer;
}

void CanDrives::send(uint32_t axis, CanPacket& packet) {
  packet.id = static_cast<uint16_t>(kSdoRequest + axis);
  packet.remote = 0;
  packet.length = kCanDataBytes;
  question_ = packet;
  waitsFor_ = axis;
  isToSend_ = true;
}

} // namespace rung::io
