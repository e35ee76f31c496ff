// A network of two in memory: the control and its device, each with ports of its own. What one sends the other can
// receive at once, in order. Addresses do not count: there is nobody else.
#pragma once
#include <array>

#include "sim/nct/line.h"

namespace rung::sim::nct {

// Bytes that have been sent and not yet received.
class Inbox {
public:
  size_t used() const { return used_; }
  size_t room() const { return bytes_.size() - used_; }
  void push(std::span<const uint8_t> from); // at most `room`
  size_t copy(std::span<uint8_t> to) const; // the oldest; how many there were
  void drop(size_t count);                  // at most `used`
  void clear() { used_ = 0; }

private:
  std::array<uint8_t, size_t{16} * 1024> bytes_{}; // eleven of the longest messages
  size_t begin_ = 0;
  size_t used_ = 0;
};

class MemoryLine final : public Line {
public:
  MemoryLine() = default;
  MemoryLine(const MemoryLine&) = delete;
  MemoryLine& operator=(const MemoryLine&) = delete;
  // Before the first use of both, for their life.
  static void join(MemoryLine& a, MemoryLine& b);

  int32_t openUdp(uint16_t port) override;
  int32_t listen(uint16_t port) override;
  int32_t connect(Endpoint to, int settleMs) override; // done, or refused, at once
  std::optional<int32_t> connected() override { return isOpen() ? 0 : kWindowsRefused; }
  void accept() override;
  bool isOpen() const override { return role_ == Role::Udp || current().open; }
  void close() override;
  void closeConnection() override;

  Received receive(std::span<uint8_t> to, bool peek) override;
  Sent send(std::span<const uint8_t> from) override; // 10054 once the other side has closed
  // A datagram for a port that is not open, or for an inbox without room, is lost, as UDP's are.
  Sent sendTo(std::span<const uint8_t> from, Endpoint to) override;

private:
  enum class Role : uint8_t { None, Udp, Server, Client };
  struct DatagramHeader {
    uint16_t bytes = 0;
    uint16_t port = 0; // of the sender
  };
  // This side of a connection; for UDP `inbox` alone.
  struct End {
    bool open = false;
    End* peer = nullptr; // null: the other side has closed
    Inbox inbox;
  };

  static void closeEnd(End& end);
  End& current() { return ends_[current_]; }
  const End& current() const { return ends_[current_]; }
  End& next() { return ends_[1 - current_]; } // of a server: has come in and is not yet accepted
  Received receiveDatagram(std::span<uint8_t> to, bool peek);

  MemoryLine* other_ = nullptr;
  Role role_ = Role::None;
  uint16_t port_ = 0;
  std::array<End, 2> ends_;
  size_t current_ = 0;
};

} // namespace rung::sim::nct
