// The network in memory.
#include "sim/nct/memory_line.h"

#include <algorithm>
#include <cstring>

namespace rung::sim::nct {

void Inbox::push(std::span<const uint8_t> from) {
  const size_t end = (begin_ + used_) % bytes_.size();
  const size_t first = std::min(from.size(), bytes_.size() - end);
  std::copy_n(from.data(), first, bytes_.data() + end);
  std::copy_n(from.data() + first, from.size() - first, bytes_.data());
  used_ += from.size();
}

size_t Inbox::copy(std::span<uint8_t> to) const {
  const size_t count = std::min(to.size(), used_);
  const size_t first = std::min(count, bytes_.size() - begin_);
  std::copy_n(bytes_.data() + begin_, first, to.data());
  std::copy_n(bytes_.data(), count - first, to.data() + first);
  return count;
}

void Inbox::drop(size_t count) {
  begin_ = (begin_ + count) % bytes_.size();
  used_ -= count;
}

void MemoryLine::join(MemoryLine& a, MemoryLine& b) {
  a.other_ = &b;
  b.other_ = &a;
}

// ---- opening and closing -----------------------------------------------------------------------------------------

int32_t MemoryLine::openUdp(uint16_t port) {
  close();
  role_ = Role::Udp;
  port_ = port;
  return 0;
}

int32_t MemoryLine::listen(uint16_t port) {
  close();
  role_ = Role::Server;
  port_ = port;
  return 0;
}

int32_t MemoryLine::connect(Endpoint to, int) {
  close();
  End& theirs = other_->next();
  // A server keeps at most one client that waits to be accepted.
  if (other_->role_ != Role::Server || other_->port_ != to.port || theirs.open) return kWindowsRefused;
  role_ = Role::Client;
  current().open = theirs.open = true;
  current().peer = &theirs;
  theirs.peer = &current();
  return 0;
}

void MemoryLine::accept() {
  if (role_ == Role::Server && !current().open && next().open) current_ = 1 - current_;
}

// The other side can still receive data sent before.
void MemoryLine::closeEnd(End& end) {
  if (end.peer != nullptr) end.peer->peer = nullptr;
  end.open = false;
  end.peer = nullptr;
  end.inbox.clear();
}

void MemoryLine::closeConnection() { closeEnd(current()); }

void MemoryLine::close() {
  for (End& end : ends_) closeEnd(end);
  role_ = Role::None;
  port_ = 0;
}

// ---- data --------------------------------------------------------------------------------------------------------

Received MemoryLine::receiveDatagram(std::span<uint8_t> to, bool peek) {
  Inbox& inbox = current().inbox;
  DatagramHeader header;
  std::array<uint8_t, sizeof header + kMostNetworkBytes> message{};
  if (inbox.used() == 0) return {.nothing = true};
  inbox.copy(message);
  std::memcpy(&header, message.data(), sizeof header);
  const size_t bytes = std::min<size_t>(to.size(), header.bytes);
  std::copy_n(message.data() + sizeof header, bytes, to.data());
  if (!peek) inbox.drop(sizeof header + header.bytes);
  return {.bytes = bytes, .from = {0, header.port}};
}

Received MemoryLine::receive(std::span<uint8_t> to, bool peek) {
  if (role_ == Role::Udp) return receiveDatagram(to, peek);
  End& end = current();
  const size_t bytes = end.inbox.copy(to);
  if (!peek) end.inbox.drop(bytes);
  return {.bytes = bytes, .nothing = bytes == 0 && end.peer != nullptr};
}

Sent MemoryLine::send(std::span<const uint8_t> from) {
  End* peer = current().peer;
  if (peer == nullptr) return {.error = kWindowsReset};
  const size_t bytes = std::min(from.size(), peer->inbox.room());
  peer->inbox.push(from.first(bytes));
  return {.bytes = bytes};
}

Sent MemoryLine::sendTo(std::span<const uint8_t> from, Endpoint to) {
  Inbox& inbox = other_->current().inbox;
  const DatagramHeader header{static_cast<uint16_t>(from.size()), port_};
  if (other_->role_ == Role::Udp && other_->port_ == to.port && inbox.room() >= sizeof header + from.size()) {
    std::array<uint8_t, sizeof header> bytes{};
    std::memcpy(bytes.data(), &header, sizeof header);
    inbox.push(bytes);
    inbox.push(from);
  }
  return {.bytes = from.size()};
}

} // namespace rung::sim::nct
