// The way of the simulated control, or of its device, into a network: one connection at a time. Errors are those of
// Windows Sockets, which the control reports (man. l.3975). Nothing here waits, unless it says so, or allocates.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace rung::sim::nct {

inline constexpr uint32_t kMostNetworkWords = 350; // of a message (l.4029)
inline constexpr size_t kMostNetworkBytes = size_t{kMostNetworkWords} * 4;

// An IPv4 address, the first byte the highest, as a program writes it: 192.168.1.12 is 0xC0A8010C.
struct Endpoint {
  uint32_t address = 0;
  uint16_t port = 0;
};

enum WindowsError : int32_t {
  kWindowsFault = 10014, // a bad address of data
  kWindowsInvalid = 10022,
  kWindowsUnreachable = 10051, // not on the loopback
  kWindowsReset = 10054,
  kWindowsTimeout = 10060,
  kWindowsRefused = 10061,      // no listener
  kWindowsDisconnected = 10101, // the other side has closed the connection
};

struct Received {
  size_t bytes = 0; // of a stream: 0 is its end
  int32_t error = 0;
  bool nothing = false; // neither data nor an error
  Endpoint from;        // of a datagram
};

struct Sent {
  size_t bytes = 0;
  int32_t error = 0; // 0 and 0 bytes: no room now
};

class Line {
public:
  virtual ~Line() = default;

  // Each closes what is open, and gives 0 or an error; then the line is closed. `port`: own.
  virtual int32_t openUdp(uint16_t port) = 0;
  virtual int32_t listen(uint16_t port) = 0;
  // Connects in the background: `connected` says when. `settleMs`: how long it may wait for that.
  virtual int32_t connect(Endpoint to, int settleMs) = 0;
  // 0 or an error; nothing: still connecting.
  virtual std::optional<int32_t> connected() = 0;
  // After `listen`, while no client is connected: accepts the next client that waits.
  virtual void accept() = 0;
  // Data can be sent and received: UDP, or a stream that this side has not closed.
  virtual bool isOpen() const = 0;
  virtual void close() = 0;
  // The connection alone: what listens keeps listening.
  virtual void closeConnection() = 0;

  // A datagram, what is beyond the end of `to` is lost; or what the stream has, at most `to`. `peek` leaves it there.
  virtual Received receive(std::span<uint8_t> to, bool peek) = 0;
  virtual Sent send(std::span<const uint8_t> from) = 0;
  virtual Sent sendTo(std::span<const uint8_t> from, Endpoint to) = 0;
};

// A network of two in memory: the control and its device, each with ports of its own. What one sends the other can
// receive at once, in order. Addresses are ignored: there is no other device.

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
