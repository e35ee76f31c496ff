// A serial port as a program sees it (see port.h).
#include "machine/io/com/port.h"

namespace rung::io::com {

void Port::powerOn() noexcept {
  clear();
  sendOverflow_ = false;
  lostSeen_ = fromLine_.lost();
}

// The ring's size is an upper bound for this side.
bool Port::send(std::span<const uint8_t> bytes) noexcept {
  if (!settings_.isActive) return false;
  if (bytes.size() > kQueueBytes - toLine_.size()) {
    sendOverflow_ = true;
    return false;
  }
  filling_.store(true, std::memory_order_relaxed); // seen with the first byte at the latest
  for (const uint8_t byte : bytes) toLine_.push(byte & settings_.mask());
  filling_.store(false, std::memory_order_release);
  return true;
}

std::optional<uint8_t> Port::receive() noexcept {
  uint8_t byte = 0;
  if (!settings_.isActive || !fromLine_.pop(byte)) return std::nullopt;
  return byte;
}

// Those that are there now: the line may bring more meanwhile.
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
  return (hasError() ? kPortError : 0) | (sent ? kSendOverflow : 0) | (received ? kReceiveOverflow : 0);
}

void Port::dropToSend() noexcept {
  uint8_t byte = 0;
  for (uint32_t left = toSend(); left > 0; --left) toLine_.pop(byte);
}

// The size first: a byte of a block that it counts makes the flag visible.
uint32_t Port::toSend() const noexcept {
  const uint32_t bytes = toLine_.size();
  return filling_.load(std::memory_order_acquire) ? 0 : bytes;
}

} // namespace rung::io::com
