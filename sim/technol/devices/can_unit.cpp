// A simulated unit.
#include "sim/technol/devices/can_unit.h"

#include <algorithm>

namespace rung::sim::technol {

namespace {

using namespace io;

constexpr uint32_t kDeviceType = 0x00030191; // inputs and outputs of CiA 401
constexpr uint32_t kMaker = 1;
constexpr std::string_view kNames[kUnitGroups] = {"INOUT08", "KLA50", "TOC"};
constexpr uint16_t kPotentiometer = 0x6404;
constexpr uint8_t kEverySync = 1, kMostSyncs = 240, kAtRequest = 252; // transmission types (l.4699-4703)
constexpr uint8_t kLastOfDisplay = 19;
constexpr PdoFields kDefaultOutputs = {{{kWriteOutput, 1},
                                        {kWriteOutput, 2},
                                        {kWriteOutput, 3},
                                        {kWriteOutput, 4},
                                        kNoField,
                                        kNoField,
                                        kNoField,
                                        kNoField}};
constexpr PdoFields kDefaultInputs = {
    {{kReadInput, 1}, {kReadInput, 2}, {kReadInput, 3}, {kReadInput, 4}, kNoField, kNoField, kNoField, kNoField}};

sdo::Object fieldOf(uint32_t mapping) {
  return {static_cast<uint16_t>(mapping >> 16), static_cast<uint8_t>(mapping >> 8)};
}

bool isMapping(sdo::Object place) {
  return (place.index == kRpdoMapping || place.index == kTpdoMapping) && place.subindex != 0;
}

// Subindices of fields that a PDO may have.
struct Fields {
  uint16_t pdo = 0, index = 0;
  uint8_t first = 0, last = 0;
};
constexpr Fields kFields[] = {{kRpdoMapping, kUnusedField, 0, 0},
                              {kRpdoMapping, kWriteOutput, 1, 4},
                              {kRpdoMapping, kDisplay, kDisplayRow, kLastOfDisplay},
                              {kTpdoMapping, kUnusedField, 0, 0},
                              {kTpdoMapping, kReadInput, 1, 4},
                              {kTpdoMapping, kMatrixInput, 1, 4},
                              {kTpdoMapping, kEncoderCounter, 1, 3},
                              {kTpdoMapping, kWheelKeys, 1, 2}};

// Only fields of eight bits can be mapped (l.4705-4709).
bool isMappable(uint16_t pdo, uint32_t mapping) {
  const sdo::Object field = fieldOf(mapping);
  return mapping == mappingOf(field) && std::any_of(std::begin(kFields), std::end(kFields), [&](const Fields& known) {
           return known.pdo == pdo && known.index == field.index && field.subindex >= known.first &&
                  field.subindex <= known.last;
         });
}

// Error codes of emergencies (CiA 301, CiA 401).
constexpr uint16_t kNoError = 0, kGenericError = 0x1000, kShortedOutputs = 0x2300;

} // namespace

SimulatedUnit::SimulatedUnit(uint32_t group, uint32_t board)
    : group_(group), board_(board), node_(nodeOf(group, board)) {
  if (group == kHandwheel) display_.resize(1);
  objects_.add({sdo::kDeviceType, 4, kDeviceType});
  objects_.add({sdo::kErrorRegister, 1});
  objects_.add({sdo::kVendor, 4, kMaker});
  for (uint8_t i = 1; i <= kUnitOutputs; ++i) {
    objects_.add({{kShortedOutput, i}, 1});
    objects_.add({{kWriteOutput, i}, 1});
  }
  for (uint8_t i = 1; i <= kUnitInputs; ++i) objects_.add({{kReadInput, i}, 1});
  for (uint8_t i = 1; i <= 8; ++i) objects_.add({{kPotentiometer, i}, 1});
  for (const sdo::Object place : {kTpdo2Type, kWheelMode}) objects_.add({place, 1, 0, ObjectAccess::ReadWrite});
  objects_.add({kTpdo2Id, 4, 0, ObjectAccess::ReadWrite});
  objects_.add({kMatrixOutputs, 2, 0, ObjectAccess::ReadWrite});
  for (const uint16_t pdo : {kRpdoMapping, kTpdoMapping}) {
    objects_.add({{pdo, 0}, 1, kPdoFields});
    for (uint8_t i = 1; i <= kPdoFields; ++i) objects_.add({{pdo, i}, 4, 0, ObjectAccess::ReadWrite});
  }
  for (uint8_t i = 1; group == kHandwheel && i <= kLastOfDisplay; ++i)
    objects_.add({{kDisplay, i}, 1, 0, ObjectAccess::ReadWrite});
  setDefaults();
}

void SimulatedUnit::setDefaults() {
  rpdo_ = kDefaultOutputs;
  tpdo_ = kDefaultInputs;
  for (uint8_t i = 0; i < kPdoFields; ++i) {
    objects_.set({kRpdoMapping, static_cast<uint8_t>(i + 1)}, mappingOf(rpdo_[i]));
    objects_.set({kTpdoMapping, static_cast<uint8_t>(i + 1)}, mappingOf(tpdo_[i]));
  }
  sendsAnalogue_ = group_ == kInOut08;
  objects_.set(kTpdo2Id, kTpdo2 + node_ + (sendsAnalogue_ ? 0 : kNotValid));
  objects_.set(kTpdo2Type, kEverySync);
  objects_.set(kWheelMode, 0);
  objects_.set(kMatrixOutputs, 0);
}

void SimulatedUnit::power() {
  wires_.error = 0;
  wires_.shorts = {};
  wires_.silent = false;
  operational_ = false;
  received_ = shown_ = {};
  outputs_ = {};
  reported_ = 0;
  reportedShorts_ = {};
  for (HandwheelDisplay& display : display_) display.clear();
  setDefaults();
}

// The unit switches shorted outputs off by itself (man. l.4511-4517).
uint8_t SimulatedUnit::output(uint32_t port) const { return outputs_[port] & ~wires_.shorts[port]; }

uint8_t SimulatedUnit::errorRegister() const {
  const bool shorted = std::any_of(wires_.shorts.begin(), wires_.shorts.end(), [](uint8_t bits) { return bits != 0; });
  const auto error = static_cast<uint8_t>(wires_.error | (shorted ? kErrorShort : 0));
  return error == 0 ? 0 : error | kErrorAny;
}

void SimulatedUnit::tick(NodePackets& answers) {
  if (wires_.silent) return;
  const uint8_t now = errorRegister();
  if (now == reported_ && wires_.shorts == reportedShorts_) return;
  reported_ = now;
  reportedShorts_ = wires_.shorts;
  const uint16_t code = now == 0 ? kNoError : (now & kErrorShort) != 0 ? kShortedOutputs : kGenericError;
  CanPacket packet{.id = static_cast<uint16_t>(kEmergency + node_), .length = kCanDataBytes};
  putNumber(packet.data, 2, code);
  packet.data[2] = now;
  answers.push(packet);
}

void SimulatedUnit::receive(const CanPacket& packet, NodePackets& answers) {
  if (wires_.silent) return;
  if (isNodeCommandFor(packet, node_)) {
    operational_ = packet.data[0] == kStartNode;
  } else if (packet.id == kSync) {
    if (!operational_) return;
    takeOver();
    sendInputs(answers);
  } else if (packet.id == kRpdo1 + node_) {
    std::copy_n(packet.data, received_.size(), received_.begin());
  } else if (packet.id == kSdoRequest + node_) {
    answer(packet, answers);
  }
}

// Stores the bytes of RPDO1 in their mapped objects; a display that is not mapped shows nothing.
void SimulatedUnit::takeOver() {
  for (uint32_t i = 0; i < kPdoFields; ++i) {
    const sdo::Object field = rpdo_[i];
    if (field.index == kWriteOutput && field.subindex <= kUnitOutputs) outputs_[field.subindex - 1u] = received_[i];
    if (field.index != kDisplay) continue;
    const auto* const shown = std::find(kWheelOutputFields.begin(), kWheelOutputFields.end(), field);
    const auto place = static_cast<size_t>(shown - kWheelOutputFields.begin());
    if (place < shown_.size()) shown_[place] = received_[i];
  }
  for (HandwheelDisplay& display : display_) display.show(shown_);
}

uint8_t SimulatedUnit::input(sdo::Object field) const {
  const uint32_t number = field.subindex - 1u;
  switch (field.index) {
  case kReadInput: return wires_.in[number];
  case kMatrixInput: return wires_.keys[number];
  case kWheelKeys: return objects_.value(kWheelMode) != 0 ? wires_.in[number] : 0;
  case kEncoderCounter: return number < wires_.encoders.size() ? static_cast<uint8_t>(wires_.encoders[number]) : 0;
  default: return 0;
  }
}

void SimulatedUnit::sendInputs(NodePackets& answers) const {
  CanPacket inputs{.id = static_cast<uint16_t>(kTpdo1 + node_), .length = kCanDataBytes};
  for (uint32_t i = 0; i < kPdoFields; ++i) inputs.data[i] = input(tpdo_[i]);
  answers.push(inputs);
  if (!sendsAnalogue_) return;
  CanPacket analogue{.id = static_cast<uint16_t>(kTpdo2 + node_), .length = kCanDataBytes};
  std::copy(wires_.analogue.begin(), wires_.analogue.end(), analogue.data);
  answers.push(analogue);
}

void SimulatedUnit::refresh() {
  objects_.set(sdo::kErrorRegister, errorRegister());
  for (uint8_t i = 0; i < kUnitOutputs; ++i) {
    const auto subindex = static_cast<uint8_t>(i + 1);
    objects_.set({kShortedOutput, subindex}, wires_.shorts[i]);
    objects_.set({kWriteOutput, subindex}, outputs_[i]);
  }
  for (uint8_t i = 0; i < kUnitInputs; ++i) objects_.set({kReadInput, static_cast<uint8_t>(i + 1)}, wires_.in[i]);
  for (uint8_t i = 0; i < 8; ++i) objects_.set({kPotentiometer, static_cast<uint8_t>(i + 1)}, wires_.analogue[i]);
}

// The name is longer than four bytes, so its length is sent first, then the name in one segment.
void SimulatedUnit::answer(const CanPacket& request, NodePackets& answers) {
  const std::string_view name = kNames[group_ - 1];
  if ((sdo::command(request) & 0xEF) == sdo::kReadSegment) {
    CanPacket segment{.id = static_cast<uint16_t>(kSdoAnswer + node_), .length = kCanDataBytes};
    segment.data[0] = static_cast<uint8_t>((7 - name.size()) << 1 | 1);
    std::copy(name.begin(), name.end(), segment.data + 1);
    answers.push(segment);
    return;
  }
  if (sdo::command(request) == sdo::kRead && sdo::object(request) == sdo::kName) {
    const auto length = static_cast<uint32_t>(name.size());
    answers.push(sdo::packet(kSdoAnswer + node_, sdo::kSegmented, sdo::kName, length));
    return;
  }
  if (const uint32_t code = refusal(request)) {
    answers.push(sdo::abort(node_, sdo::object(request), code));
    return;
  }
  refresh();
  const CanObject* written = nullptr;
  answers.push(objects_.answer(node_, request, written));
  if (written != nullptr) takeWritten(*written);
}

// Why a value is refused, as an SDO abort code; 0: it is accepted.
uint32_t SimulatedUnit::refusal(const CanPacket& request) const {
  if (!sdo::isWrite(request)) return 0;
  const sdo::Object place = sdo::object(request);
  const uint32_t value = sdo::value(request);
  if (place == kTpdo2Type && value != kAtRequest && (value < kEverySync || value > kMostSyncs)) return sdo::kWrongValue;
  if (!isMapping(place)) return 0;
  if (operational_) return sdo::kWrongState;
  return isMappable(place.index, value) ? 0 : sdo::kNotMappable;
}

void SimulatedUnit::takeWritten(const CanObject& object) {
  if (object.place == kTpdo2Id) sendsAnalogue_ = (object.value & kNotValid) == 0;
  if (!isMapping(object.place)) return;
  PdoFields& pdo = object.place.index == kRpdoMapping ? rpdo_ : tpdo_;
  pdo[object.place.subindex - 1u] = fieldOf(object.value);
}

// Objects and SDO.

namespace sdo = io::sdo;

void CanObjects::add(const CanObject& object) {
  if (CanObject* const old = find(object.place))
    *old = object;
  else
    objects_.push_back(object);
}

CanObject* CanObjects::find(sdo::Object place) {
  const auto found =
      std::find_if(objects_.begin(), objects_.end(), [&](const CanObject& object) { return object.place == place; });
  return found == objects_.end() ? nullptr : &*found;
}

const CanObject* CanObjects::find(sdo::Object place) const {
  const auto found =
      std::find_if(objects_.begin(), objects_.end(), [&](const CanObject& object) { return object.place == place; });
  return found == objects_.end() ? nullptr : &*found;
}

uint32_t CanObjects::value(sdo::Object place) const {
  const CanObject* const object = find(place);
  return object == nullptr ? 0 : object->value;
}

void CanObjects::set(sdo::Object place, uint32_t value) {
  if (CanObject* const object = find(place)) object->value = value;
}

uint32_t CanObjects::missing(uint16_t index) const {
  const bool known = std::any_of(objects_.begin(), objects_.end(),
                                 [&](const CanObject& object) { return object.place.index == index; });
  return known ? noSubindex_ : sdo::kNoSuchObject;
}

io::CanPacket CanObjects::answer(uint32_t node, const io::CanPacket& request, const CanObject*& written) {
  written = nullptr;
  const sdo::Object place = sdo::object(request);
  CanObject* const object = find(place);
  const bool reads = sdo::command(request) == sdo::kRead;
  if (!reads && !sdo::isWrite(request)) return sdo::abort(node, place, sdo::kUnknownCommand);
  if (object == nullptr) return sdo::abort(node, place, missing(place.index));
  if (reads && object->access == ObjectAccess::WriteOnly) return sdo::abort(node, place, sdo::kWriteOnly);
  if (reads) return sdo::answer(node, place, object->bytes, object->value);
  if (object->access == ObjectAccess::ReadOnly) return sdo::abort(node, place, sdo::kReadOnly);
  if (sdo::bytes(request) != object->bytes) return sdo::abort(node, place, sdo::kWrongLength);
  object->value = io::numberAt(request.data + 4, object->bytes);
  written = object;
  return sdo::written(node, place);
}

// A simulated drive.

namespace {

using namespace io;

constexpr uint32_t kDriveType = 0x00020192; // servo drive of CiA 402
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

// Bits whose mask is 0 keep their value in the drive.
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
  objects_.add({sdo::kDeviceType, 4, kDriveType});
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

// Changes the state one step at a time, downwards at once (CiA 402; a quick stop ends when the voltage is off).
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

// Bit 7 of the control word resets a fault whose cause is gone; the next word of the control clears the bit.
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
