// One unit: errors, mode, inputs and outputs (see unit.h). units.cpp has its SDO requests.
#include "machine/io/can/unit.h"

#include "machine/io/can/units.h"
#include "rtlib/text/hex.h"

namespace rung::io {

using namespace inouts;

namespace {

constexpr uint8_t kNotSerious = kErrorAny | kErrorShort; // man. l.3674
constexpr uint8_t kBootUp = 0;                           // the state of its first heartbeat
constexpr uint8_t kEmergencyBytes = 3;                   // up to the error register

void setBits(Inouts& data, InoutsItem item, uint8_t bits, bool on) {
  const uint32_t old = data.get(item);
  data.set(item, on ? old | bits : old & ~uint32_t{bits});
}

} // namespace

// Ports are numbered consecutively over all units (man. l.4208-4209).
CanUnit::CanUnit(uint32_t group, uint32_t board, uint8_t control) : group_(group), board_(board), control_(control) {
  data_.set(kSize, kBytes);
  data_.set(kControl, control_);
  begin();
  if (group_ != kInOut08) return;
  data_.set(kFirstIn, kUnitInputs * board_ - 3);
  data_.set(kFirstOut, kUnitOutputs * board_ - 3);
}

// The unit may have any settings. The matrix of an INOUT08 may still be on, and it sends analogue inputs unless they
// are switched off; the inputs of other units are fixed.
void CanUnit::begin() {
  waiting_ = (waiting_ | late_ | underWay_) & requests::kShorts;
  waiting_ |= requests::kRegister | requests::kMapping | requests::kIdentity;
  isPrepared_ = isStarted_ = isSdoSilent_ = false;
  late_ = underWay_ = refused_ = abort_ = 0;
  segment_ = Segment::None;
  if (group_ == kInOut08 || mode_ != kModeStandard) waiting_ |= requests::kModes;
  if (group_ == kHandwheel) waiting_ |= requests::kWheelMode | requests::kDisplay;
}

void CanUnit::tick(CanPort& port, UnitMessages& messages) {
  watch(messages);
  showErrors(messages);
  followMode();
  showInputs();
  start(port);
  ask(port, messages);
  sendRequested(port);
  reportRefusal(messages);
}

// A rejection that is repeated whenever the unit is mapped is reported once.
void CanUnit::reportRefusal(UnitMessages& messages) {
  if (abort_ != 0 && aborted_ != saidAborted_)
    report(messages, {.kind = UnitMessage::Kind::RefusesSdo, .object = aborted_, .code = abort_});
  if (abort_ != 0) saidAborted_ = aborted_;
  abort_ = 0;
}

void CanUnit::start(CanPort& port) {
  if (!isPrepared_) isPrepared_ = port.transmit(nodeCommand(kPrepareNode, node()));
  if (!isStarted_ && mayStart()) isStarted_ = port.transmit(nodeCommand(kStartNode, node()));
}

bool CanUnit::isPreparing() const { return !isStarted_ && isPending(requests::kBeforeStart); }

// Without the mapping, the inputs and outputs of a unit have their default positions (man. l.4805-4858), but the bytes
// of a handwheel's display would be outputs.
bool CanUnit::mayStart() const {
  const bool isAsked = !isPending(requests::kBeforeStart);
  if (group_ == kHandwheel) return isAsked && refused_ == 0;
  return isAsked || (isSdoSilent_ && (late_ & requests::kBeforeStart) != 0);
}

// A unit from which no packets are received, perhaps because it has no power, is sent a request from time to time; one
// that is received, but sends no inputs, may have lost its settings.
void CanUnit::watch(UnitMessages& messages) {
  ++silentMs_;
  data_.set(kCount, std::min(silentMs_, 0xFFFFu));
  if (++unheardMs_ % kUnitTimeoutMs == 0) waiting_ |= requests::kRegister;
  if (silentMs_ % kUnitTimeoutMs == 0 && unheardMs_ < kUnitTimeoutMs && isStarted_) begin();
  const bool silent = silentMs_ >= kUnitTimeoutMs && !controls(kNoTimeout);
  if (silent && !timedOut_) setBits(data_, kErrorStatus, kTimeoutMemory, true);
  using Kind = UnitMessage::Kind;
  if (silent != timedOut_) report(messages, {.kind = silent ? Kind::Silent : Kind::Answers});
  timedOut_ = silent;
}

void CanUnit::report(UnitMessages& messages, UnitMessage message) const {
  message.group = static_cast<uint8_t>(group_);
  message.board = static_cast<uint8_t>(board_);
  messages.push(message);
}

// The memory bits are set when an error begins, so that the program can reset them while it lasts (man. l.4101,
// l.4136). The error is reported to the operator unless CONTROL hides it (man. l.3514-3519).
void CanUnit::showErrors(UnitMessages& messages) {
  const auto before = static_cast<uint8_t>(data_.get(kError));
  uint8_t now = registered_;
  if (timedOut_) now |= kErrorCommunication;
  if (now != 0) now |= kErrorAny;
  data_.set(kError, now);
  if ((now & ~before) != 0) data_.set(kErrorCode, now);
  const bool isNew = (registered_ & ~before) != 0;
  setBits(data_, kErrorStatus, kErrorNow, registered_ != 0);
  setBits(data_, kErrorStatus, kTimeoutNow, timedOut_);
  if (isNew) setBits(data_, kErrorStatus, kErrorMemory, true);
  if (isNew && !controls(kHideErrors)) report(messages, {.kind = UnitMessage::Kind::Error, .code = registered_});
  setBits(data_, kErrorStatus, kZeroAll, (now & ~kNotSerious) != 0 && !controls(kNoZeroing));
}

void CanUnit::followMode() {
  const auto wanted = static_cast<uint8_t>(data_.get(kMode));
  if (wanted != mode_) {
    mode_ = wanted;
    waiting_ |= requests::kModes;
  }
  const bool done = !isPending(requests::kModes);
  if (done) data_.set(kModeNow, mode_);
  data_.set(kModePhase, done ? 0 : 1);
}

// Potentiometers are only shown in analogue mode (man. l.4351-4354), a key matrix only in matrix mode; panels have keys
// in every mode.
void CanUnit::showInputs() {
  const uint32_t mode = data_.get(kModeNow);
  for (uint32_t i = 0; i < analogue_.size(); ++i) data_.at(kAnalogue + i) = mode == kModeAnalogue ? analogue_[i] : 0;
  for (uint32_t i = 0; i < keys_.size(); ++i)
    data_.at(kKeys + i) = group_ != kInOut08 || mode == kModeMatrix ? keys_[i] : 0;
}

// The unit itself switches a shorted output off. The output then stays off until the program confirms the error by
// resetting its bit, unless CONTROL suppresses reports of shorts (man. l.3526-3531); if the short persists, switching
// the output on again causes a new error.
void CanUnit::output(uint32_t port, uint8_t wanted, uint8_t& errors, bool zeroed) {
  const uint8_t shorted = data_.at(kShort + port);
  if (controls(kNoShortReports))
    errors = 0;
  else
    errors |= static_cast<uint8_t>(shorted & (~shorts_[port] | wanted));
  shorts_[port] = shorted;
  sent_[port] = zeroed ? 0 : wanted & ~errors;
  data_.at(kOut + port) = sent_[port] & ~shorted;
}

CanPacket CanUnit::outputPacket(const std::array<uint8_t, 8>& display) {
  CanPacket packet{.id = static_cast<uint16_t>(kRpdo1 + node()), .length = kCanDataBytes};
  if (group_ == kHandwheel)
    std::copy(display.begin(), display.end(), packet.data);
  else
    std::copy(sent_.begin(), sent_.end(), packet.data);
  data_.count(kRpdoCount);
  return packet;
}

// Missing bytes leave their values unchanged.
void CanUnit::takeInputs(const CanPacket& packet) {
  data_.count(kTpdoCount);
  const uint32_t count = packet.length;
  if (packet.isObject(kTpdo2)) {
    std::copy_n(packet.data, count, analogue_.begin());
  } else if (group_ == kHandwheel) {
    takeWheel(packet);
  } else {
    std::copy_n(packet.data, std::min(count, kUnitInputs), &data_.at(kIn));
    if (count > kUnitInputs) std::copy_n(packet.data + kUnitInputs, count - kUnitInputs, keys_.begin());
  }
}

// Encoder counters are extended from their low bytes, which change by much less than 128 between two packets.
void CanUnit::takeWheel(const CanPacket& packet) {
  constexpr uint32_t kKeyBytes = 2, kEncoders = 2;
  if (packet.length < kKeyBytes + kEncoders) return;
  std::copy_n(packet.data, kKeyBytes, &data_.at(kIn));
  for (uint32_t i = 0; i < kEncoders; ++i) {
    const InoutsItem counter{inouts::kEncoder + 2 * i, 2};
    const uint32_t former = data_.get(counter);
    const auto steps = static_cast<int8_t>(packet.data[kKeyBytes + i] - former);
    data_.set(counter, former + static_cast<uint32_t>(steps));
  }
}

bool CanUnit::take(const CanPacket& packet) {
  if (!packet.isFromNode()) return false;
  const bool isBack = unheardMs_ >= kUnitTimeoutMs || (packet.isObject(kHeartbeat) && packet.data[0] == kBootUp);
  unheardMs_ = 0;
  data_.set(kPresent, 1);
  const bool isOwn = takeOwn(packet);
  if (packet.isObject(kTpdo1) || (isPreparing() && !timedOut_)) silentMs_ = 0;
  if (isBack) begin();
  return isOwn;
}

// An emergency contains error code, error register and manufacturer-specific data (CiA 301).
bool CanUnit::takeOwn(const CanPacket& packet) {
  if (packet.isObject(kTpdo1) || packet.isObject(kTpdo2)) return takeInputs(packet), true;
  if (packet.isObject(kSdoAnswer)) return takeAnswer(packet);
  if (packet.isObject(kEmergency) && packet.length >= kEmergencyBytes) {
    const uint8_t shorts = (registered_ | packet.data[2]) & kErrorShort;
    registered_ = packet.data[2];
    if (shorts != 0) waiting_ |= requests::kShorts;
  }
  return false;
}

// Sentences for the log.

namespace {

std::string hex(uint32_t value, uint32_t bytes) { return text::hexOfNumber(value, bytes) + "h"; }

std::string nameOf(sdo::Object object) { return hex(object.index, 2) + ":" + std::to_string(object.subindex); }

std::string sentenceOf(const UnitMessage& message) {
  switch (message.kind) {
  case UnitMessage::Kind::Silent: return "does not answer";
  case UnitMessage::Kind::Answers: return "answers again";
  case UnitMessage::Kind::Error: return "reports an error, register 1001h is " + hex(message.code, 1);
  case UnitMessage::Kind::SilentSdo: return "does not answer the request for object " + nameOf(message.object);
  case UnitMessage::Kind::RefusesSdo:
    return "rejects the value of object " + nameOf(message.object) + ", abort code " + hex(message.code, 4);
  }
  return {};
}

} // namespace

std::string textOf(const UnitMessage& message) {
  return std::string("CAN unit ") + kUnitGroupNames[message.group - 1].unit + " " + std::to_string(message.board) +
         " (node " + hex(nodeOf(message.group, message.board), 1) + ") " + sentenceOf(message);
}

} // namespace rung::io
