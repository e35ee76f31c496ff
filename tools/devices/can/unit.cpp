// One unit: errors, mode, inputs and outputs (see unit.h). What is asked of it is in unit_requests.cpp.
#include "tools/devices/can/unit.h"

#include "tools/devices/can/unit_requests.h"

namespace rung::devices {

using namespace inouts;

namespace {

constexpr uint8_t kNotSerious = kErrorAny | kErrorShort; // man. l.3674
constexpr uint8_t kStartNode = 1;                        // network management of CiA 301

void setBits(Inouts& data, InoutsItem item, uint8_t bits, bool on) {
  const uint32_t old = data.get(item);
  data.set(item, on ? old | bits : old & ~uint32_t{bits});
}

} // namespace

// Ports are numbered on through the units (man. l.4208-4209).
CanUnit::CanUnit(uint32_t group, uint32_t board, uint8_t control) : group_(group), board_(board), control_(control) {
  data_.set(kSize, kBytes);
  data_.set(kControl, control_);
  waiting_ = requests::kAtStart;
  if (group_ != kInOut08) return;
  data_.set(kFirstIn, kUnitInputs * board_ - 3);
  data_.set(kFirstOut, kUnitOutputs * board_ - 3);
}

void CanUnit::tick(CanPort& port) {
  watch(port);
  showErrors();
  followMode();
  showInputs();
  askNext(port);
  sendRequested(port);
}

// A unit that has no power is started again when it is back: the order is repeated as long as it is silent.
void CanUnit::watch(CanPort& port) {
  ++silentMs_;
  data_.set(kCount, std::min(silentMs_, 0xFFFFu));
  if (silentMs_ % kUnitTimeoutMs == 0) port.transmit(packetOf(kNodeControl, {kStartNode, node()}));
  const bool silent = silentMs_ >= kUnitTimeoutMs && !controls(kNoTimeout);
  if (silent && !timedOut_) setBits(data_, kErrorStatus, kTimeoutMemory, true);
  timedOut_ = silent;
}

// Memories are set when an error begins, so that the program may reset them while it lasts (man. l.4101, l.4136).
void CanUnit::showErrors() {
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

// Potentiometers count in the analogue mode alone (man. l.4351-4354), a matrix of keys in that of the matrix; panels
// have keys in every mode.
void CanUnit::showInputs() {
  const uint32_t mode = data_.get(kModeNow);
  for (uint32_t i = 0; i < analogue_.size(); ++i) data_.at(kAnalogue + i) = mode == kModeAnalogue ? analogue_[i] : 0;
  for (uint32_t i = 0; i < keys_.size(); ++i)
    data_.at(kKeys + i) = group_ != kInOut08 || mode == kModeMatrix ? keys_[i] : 0;
}

// The unit itself switches a shorted output off. Beyond that it stays off until the program confirms the error by
// resetting its bit, unless it does not want to know of errors (man. l.3526-3531); where the short lasts, switching the
// output on again is an error again.
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

void CanUnit::takeInputs(const CanPacket& packet) {
  data_.count(kTpdoCount);
  if (packet.isObject(kTpdo2)) {
    std::copy_n(packet.data, analogue_.size(), analogue_.begin());
  } else if (group_ == kHandwheel) {
    std::copy_n(packet.data, 2, &data_.at(kIn));
    std::copy_n(packet.data + 2, 4, &data_.at(kEncoder));
  } else {
    std::copy_n(packet.data, kUnitInputs, &data_.at(kIn));
    std::copy_n(packet.data + kUnitInputs, keys_.size(), keys_.begin());
  }
}

// An emergency is error code, error register and what the maker likes (CiA 301).
bool CanUnit::take(const CanPacket& packet) {
  const bool wasSilent = silentMs_ > kUnitTimeoutMs;
  silentMs_ = 0;
  data_.set(kPresent, 1);
  if (wasSilent) waiting_ |= requests::kRegister;
  if (packet.isObject(kTpdo1) || packet.isObject(kTpdo2)) return takeInputs(packet), true;
  if (packet.isObject(kSdoAnswer)) return takeAnswer(packet);
  if (packet.isObject(kEmergency)) {
    const uint8_t shorts = (registered_ | packet.data[2]) & kErrorShort;
    registered_ = packet.data[2];
    if (shorts != 0) waiting_ |= requests::kShorts;
  }
  return false;
}

} // namespace rung::devices
