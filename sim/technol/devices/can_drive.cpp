// A simulated drive (see can_drive.h).
#include "sim/technol/devices/can_drive.h"

namespace rung::sim::technol {
namespace {

using namespace io;

constexpr uint32_t kDeviceType = 0x00020192; // servo drive of CiA 402
constexpr sdo::Object kCodeObject{0x603F, 0}, kControlObject{0x6040, 0}, kStatusObject{0x6041, 0};

// Bits of the control word (CiA 402).
constexpr uint16_t kSwitchOn = 1, kVoltage = 2, kNoQuickStop = 4, kEnable = 8, kFaultReset = 0x80;

// CAN_DRIVE_CMD and CAN_DRIVE_STAT of a Unidrive (man. l.9386-9441).
constexpr uint16_t kUniHealthy = 1, kUniRuns = 2, kUniZeroSpeed = 4, kUniBelowLeast = 8, kUniAtSpeed = 0x20;
constexpr uint16_t kUniEnable = 0x01, kUniTrip = 0x10;
constexpr uint16_t kTripFromProgram = 52; // tr52 (man. l.9417)
struct Mask {
  uint16_t bit, mask;
};
constexpr Mask kMasks[] = {{0x01, 0x0200}, {0x02, 0x0400}, {0x04, 0x0800},
                           {0x08, 0x1000}, {0x20, 0x4000}, {0x40, 0x8000}};

// Bits whose mask is 0 stay what they are in the drive.
uint16_t masked(uint16_t old, uint16_t word) {
  for (const Mask& mask : kMasks)
    if ((word & mask.mask) == 0) word = static_cast<uint16_t>((word & ~mask.bit) | (old & mask.bit));
  return word;
}

} // namespace

SimulatedDrive::SimulatedDrive(uint32_t number) : node_(static_cast<uint8_t>(number)) { power(); }

void SimulatedDrive::addObject(const CanObject& object) {
  configured_.push_back(object);
  objects_.add(object);
}

void SimulatedDrive::power() {
  operational_ = holds_ = silent_ = false;
  state_ = State::SwitchOnDisabled;
  word_ = received_ = code_ = manufacturer_ = 0;
  objects_.add({sdo::kDeviceType, 4, kDeviceType});
  objects_.add({sdo::kErrorRegister, 1});
  objects_.add({kCodeObject, 2});
  objects_.add({kControlObject, 2, 0, ObjectAccess::ReadWrite});
  objects_.add({kStatusObject, 2});
  for (const CanObject& object : configured_) objects_.add(object);
  refresh();
}

void SimulatedDrive::receive(const CanPacket& packet, NodePackets& answers) {
  if (silent_) return;
  if (isNodeCommandFor(packet, node_)) {
    operational_ = packet.data[0] == kStartNode;
  } else if (packet.id == kSync) {
    if (!operational_) return;
    control(received_, answers);
    sendStatus(answers);
  } else if (packet.id == kRpdo1 + node_) {
    received_ = static_cast<uint16_t>(numberAt(packet.data, 2));
  } else if (packet.id == kSdoRequest + node_) {
    answer(packet, answers);
  }
  refresh();
}

// The trip of a Unidrive comes from the program's bit (tr52).
void SimulatedDrive::control(uint16_t word, NodePackets& answers) {
  if (type_ == DriveType::Unidrive) {
    word = masked(word_, word);
    const bool trips = (word & ~word_ & kUniTrip) != 0;
    word_ = word;
    if (trips) fault(kTripFromProgram, false, answers);
    return;
  }
  if ((word & ~word_ & kFaultReset) != 0) resetFault();
  word_ = word;
  follow(word);
}

// A step at a time, downwards at once (CiA 402; a quick stop ends where the voltage is off).
void SimulatedDrive::follow(uint16_t word) {
  if (state_ == State::Fault) return;
  const bool on = (word & kSwitchOn) != 0, enable = on && (word & kEnable) != 0;
  if ((word & (kVoltage | kNoQuickStop)) != (kVoltage | kNoQuickStop)) {
    state_ = State::SwitchOnDisabled;
  } else if (!on) {
    state_ = State::ReadyToSwitchOn;
  } else if (state_ == State::ReadyToSwitchOn || (state_ == State::Enabled && !enable)) {
    state_ = State::SwitchedOn;
  } else if (state_ == State::SwitchedOn && enable) {
    state_ = State::Enabled;
  }
}

void SimulatedDrive::fault(uint16_t code, bool holds, NodePackets& answers) {
  holds_ = holds && code != 0;
  if (code == 0) return;
  code_ = code;
  state_ = State::Fault;
  refresh();
  if (silent_) return;
  CanPacket packet{.id = static_cast<uint16_t>(kEmergency + node_), .length = kCanDataBytes};
  putNumber(packet.data, 2, code);
  packet.data[2] = kErrorAny;
  answers.push(packet);
}

void SimulatedDrive::resetFault() {
  if (state_ != State::Fault || holds_) return;
  state_ = State::SwitchOnDisabled;
  code_ = 0;
}

uint16_t SimulatedDrive::status() const {
  if (type_ == DriveType::Unidrive) {
    const bool healthy = state_ != State::Fault;
    const bool runs = healthy && (word_ & kUniEnable) != 0;
    return static_cast<uint16_t>((healthy ? kUniHealthy : 0) | (runs ? kUniRuns | kUniBelowLeast | kUniAtSpeed : 0) |
                                 kUniZeroSpeed);
  }
  const uint16_t warning = manufacturer_ != 0 ? kDriveWarning : 0;
  switch (state_) {
  case State::SwitchOnDisabled: return warning | kDriveBraked | kDriveVoltage;
  case State::ReadyToSwitchOn: return warning | kDriveVoltage | kDriveNoQuickStop | kDriveReady;
  case State::SwitchedOn: return warning | kDriveVoltage | kDriveNoQuickStop | kDriveReady | kDriveOn;
  case State::Enabled: return warning | kDriveVoltage | kDriveNoQuickStop | kDriveReady | kDriveOn | kDriveEnabled;
  case State::Fault: return warning | kDriveFault;
  }
  return 0;
}

void SimulatedDrive::sendStatus(NodePackets& answers) const {
  CanPacket packet{.id = static_cast<uint16_t>(kTpdo1 + node_), .length = 4};
  putNumber(packet.data, 2, status());
  putNumber(packet.data + 2, 2, manufacturer_);
  answers.push(packet);
}

void SimulatedDrive::refresh() {
  objects_.set(sdo::kErrorRegister, state_ == State::Fault ? kErrorAny : 0);
  objects_.set(kCodeObject, code_);
  objects_.set(kControlObject, word_);
  objects_.set(kStatusObject, status());
}

// Bit 7 of the control word resets a fault whose cause is gone; the control's own word then takes the bit back.
void SimulatedDrive::answer(const CanPacket& request, NodePackets& answers) {
  const CanObject* written = nullptr;
  answers.push(objects_.answer(node_, request, written));
  if (written == nullptr || written->place != kControlObject) return;
  const auto word = static_cast<uint16_t>(written->value);
  if (type_ == DriveType::Unidrive) {
    if ((word & kFaultReset) != 0) resetFault();
  } else {
    control(word, answers);
  }
}

} // namespace rung::sim::technol
