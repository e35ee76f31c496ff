// Simulated serial ports (see com.h).
#include "sim/technol/devices/com.h"

#include <algorithm>

namespace rung::sim::technol {

// ---- line --------------------------------------------------------------------------------------------------------

void ComLine::powerOn() {
  port_.dropToSend();
  port_.setError(false);
  progress_ = 0;
  sentFirst_ = sentCount_ = 0;
}

// ComSpeed, in bits per second, is the progress in thousandths of a bit per millisecond. A byte begins when it is in
// the queue and the previous one has been sent; it has been sent with its last stop bit.
void ComLine::tick() {
  if (!port_.settings().isActive || port_.hasError()) return;
  const uint64_t byte = uint64_t{1000} * port_.settings().bitsOfByte();
  uint32_t queued = port_.toSend();
  progress_ = queued > 0 ? progress_ + port_.settings().speed : 0;
  for (; queued > 0 && progress_ >= byte; --queued) {
    progress_ -= byte;
    leave();
  }
  if (queued == 0) progress_ = 0; // the line is idle: the next byte begins with the next tick
}

void ComLine::leave() {
  if (sentCount_ == kSentBytes) {
    sentFirst_ = (sentFirst_ + 1) % kSentBytes;
    --sentCount_;
  }
  port_.takeToSend(sent_[(sentFirst_ + sentCount_++) % kSentBytes]);
}

void ComLine::receive(std::span<const uint8_t> bytes) {
  if (port_.hasError()) return;
  for (const uint8_t byte : bytes) port_.deliver(byte);
}

bool ComLine::takeSent(std::span<const uint8_t> expected) {
  if (expected.size() > sentCount_) return false;
  for (uint32_t i = 0; i < expected.size(); ++i)
    if (sentByte(i) != expected[i]) return false;
  const auto count = static_cast<uint32_t>(expected.size());
  sentFirst_ = (sentFirst_ + count) % kSentBytes;
  sentCount_ -= count;
  return true;
}

// ---- ports -------------------------------------------------------------------------------------------------------

std::string ComPorts::configure(std::string_view key, std::string_view value) {
  io::com::PortKey port;
  if (std::string wrong = readPortKey(key, port); !wrong.empty()) return wrong;
  Unit& unit = units_[port.number];
  io::com::Settings settings = unit.port.settings();
  if (const std::string wrong = settings.set(port.attribute, value); !wrong.empty())
    return std::string(key) + ": " + wrong;
  unit.port.configure(settings);
  if (settings.isActive) unit.line.makeRoom();
  return {};
}

void ComPorts::powerOn() {
  for (Unit& unit : units_) {
    unit.port.powerOn();
    unit.line.powerOn();
  }
}

void ComPorts::tick() {
  for (Unit& unit : units_) unit.line.tick();
}

std::string ComPorts::inactive(uint32_t number) const {
  const bool isActive = number < kMost && units_[number].port.settings().isActive;
  return isActive ? "" : "the serial port " + std::to_string(number) + " is not active";
}

std::string ComPorts::receive(uint32_t number, std::span<const uint8_t> bytes) {
  std::string wrong = inactive(number);
  if (wrong.empty()) units_[number].line.receive(bytes);
  return wrong;
}

std::string ComPorts::setError(uint32_t number, bool isWrong) {
  std::string wrong = inactive(number);
  if (wrong.empty()) units_[number].port.setError(isWrong);
  return wrong;
}

} // namespace rung::sim::technol
