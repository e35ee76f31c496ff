// See port.h.
#include "machine/io/com/port.h"

#include <span>

#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::io {

namespace com {

void Port::powerOn() noexcept {
  clear();
  sendOverflow_ = false;
  lostSeen_ = fromLine_.lost();
}

// On this side, the size of the ring is an upper bound.
bool Port::send(std::span<const uint8_t> bytes) noexcept {
  if (!settings_.isActive) return false;
  if (bytes.size() > kQueueBytes - toLine_.size()) {
    sendOverflow_ = true;
    return false;
  }
  filling_.store(true, std::memory_order_relaxed); // visible no later than the first byte
  for (const uint8_t byte : bytes) toLine_.push(byte & settings_.mask());
  filling_.store(false, std::memory_order_release);
  return true;
}

std::optional<uint8_t> Port::receive() noexcept {
  uint8_t byte = 0;
  if (!settings_.isActive || !fromLine_.pop(byte)) return std::nullopt;
  return byte;
}

// Removes the bytes present now; the line may add more meanwhile.
bool Port::clear() noexcept {
  uint8_t byte = 0;
  for (uint32_t left = fromLine_.size(); left > 0; --left) fromLine_.pop(byte);
  return settings_.isActive;
}

std::optional<uint32_t> Port::received() const noexcept {
  return settings_.isActive ? std::optional(fromLine_.size()) : std::nullopt;
}

uint32_t Port::takeState() noexcept {
  if (!settings_.isActive) return kNotConfigured;
  const uint32_t lost = fromLine_.lost();
  const bool received = lost != lostSeen_;
  const bool sent = sendOverflow_;
  lostSeen_ = lost;
  sendOverflow_ = false;
  return (hasError() ? kPortError : 0u) | (sent ? kSendOverflow : 0u) | (received ? kReceiveOverflow : 0u);
}

void Port::dropToSend() noexcept {
  uint8_t byte = 0;
  for (uint32_t left = toSend(); left > 0; --left) toLine_.pop(byte);
}

// Reads the size first: a byte of a block that it includes makes the flag visible.
uint32_t Port::toSend() const noexcept {
  const uint32_t bytes = toLine_.size();
  return filling_.load(std::memory_order_acquire) ? 0 : bytes;
}

} // namespace com

// Settings of a serial port.

namespace com {

namespace {

struct Number {
  std::string_view attribute;
  uint32_t Settings::* member;
  uint32_t least, most;
};
constexpr Number kNumbers[] = {{"PhysicalComNo", &Settings::physical, 1, 256},
                               {"ComSpeed", &Settings::speed, 50, 4'000'000},
                               {"ComDataBits", &Settings::dataBits, 7, 8},
                               {"ComStopBits", &Settings::stopBits, 1, 2}};
constexpr std::string_view kParities[] = {"None", "Odd", "Even", "Mark", "Space"};

std::string expected(std::string_view attribute, std::string_view what, std::string_view value) {
  return std::string(attribute) + ": expected " + std::string(what) + ", found '" + std::string(value) + "'";
}

std::string setNumber(Settings& settings, const Number& row, std::string_view value) {
  const auto number = text::wholeIn<uint32_t>(value);
  if (!number || *number < row.least || *number > row.most)
    return expected(row.attribute, std::to_string(row.least) + " to " + std::to_string(row.most), value);
  settings.*row.member = *number;
  return {};
}

std::string setParity(Settings& settings, std::string_view value) {
  for (size_t i = 0; i < std::size(kParities); ++i)
    if (text::equalsIgnoringCase(value, kParities[i])) {
      settings.parity = static_cast<Parity>(i);
      return {};
    }
  return expected("ComParity", "None, Odd, Even, Mark or Space", value);
}

// Both methods are the same here.
std::string checkMethod(std::string_view value) {
  const bool known = text::equalsIgnoringCase(value, "Buffered") || text::equalsIgnoringCase(value, "RT");
  return known ? "" : expected("ServiceMethod", "Buffered or RT", value);
}

} // namespace

std::string Settings::set(std::string_view attribute, std::string_view value) {
  for (const Number& row : kNumbers)
    if (text::equalsIgnoringCase(attribute, row.attribute)) return setNumber(*this, row, value);
  if (text::equalsIgnoringCase(attribute, "ComParity")) return setParity(*this, value);
  if (text::equalsIgnoringCase(attribute, "ServiceMethod")) return checkMethod(value);
  if (!text::equalsIgnoringCase(attribute, "Active"))
    return "a serial port has Active, PhysicalComNo, ServiceMethod, ComSpeed, ComDataBits, ComStopBits, ComParity, not "
           "'" +
           std::string(attribute) + "'";
  if (value != "0" && value != "1") return expected("Active", "0 or 1", value);
  isActive = value == "1";
  return {};
}

bool isPortKey(std::string_view key) {
  const std::string name = nc::technol::canonical(key);
  return name.starts_with("COM[") || name.starts_with("COM.");
}

// A missing index counts as 0: COM.Active (identifier.h).
std::string readPortKey(std::string_view key, PortKey& port) {
  const std::string name = nc::technol::canonical(key);
  std::string_view rest = name;
  nc::technol::takePrefix(rest, "COM");
  port.number = nc::technol::takeIndex(rest).value_or(0);
  if (!nc::technol::takePrefix(rest, ".") || port.number >= kMostPorts)
    return "'" + std::string(key) + "' is not a serial port's attribute: COM[0].Active to COM[15].Active";
  port.attribute = rest;
  return {};
}

} // namespace com

// Answers to requests to serial ports. RLO, the first result, is 1 for an error.

namespace {

enum Command : int64_t { kClear = nc::technol::kFirstLineCommand, kReceived, kState }; // commands of COM_CONTROL

void send(com::Port& port, DeviceCall& call) { call.set(0, port.send(static_cast<uint8_t>(call.arg(1))) ? 0 : 1); }

void sendText(com::Port& port, DeviceCall& call) {
  std::array<uint8_t, com::Port::kQueueBytes + 1> room{}; // one byte more than the queue holds
  call.set(0, port.send(call.bytes(1, room)) ? 0 : 1);
}

void receive(com::Port& port, DeviceCall& call) {
  const auto byte = port.receive();
  call.set(0, byte ? 0 : 1);
  call.set(1, byte.value_or(0));
}

void control(com::Port& port, DeviceCall& call) {
  if (call.arg(1) == kState) {
    call.set(1, port.takeState());
    return;
  }
  if (call.arg(1) == kClear) {
    call.set(0, port.clear() ? 0 : 1);
    return;
  }
  const auto count = port.received();
  call.set(0, count ? 0 : 1);
  call.set(1, count.value_or(0));
}

void answerOf(com::Port& port, DeviceCall& call) {
  switch (call.kind()) {
  case ServiceKind::ComSend: return send(port, call);
  case ServiceKind::ComSendText: return sendText(port, call);
  case ServiceKind::ComReceive: return receive(port, call);
  default: return control(port, call);
  }
}

} // namespace

// A null port is answered like one that is not configured.
void answerCom(com::Port* port, DeviceCall& call) {
  if (port != nullptr) return answerOf(*port, call);
  com::Port none;
  answerOf(none, call);
}

} // namespace rung::io
