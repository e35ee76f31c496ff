// The interface of the simulated control, or of its device, to a network: one connection at a time. Errors are those of
// Windows Sockets, which the control reports (man. l.3975). Nothing here allocates, or waits unless stated.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace rung::sim::nct {

inline constexpr uint32_t kMostNetworkWords = 350; // longest message (l.4029)
inline constexpr size_t kMostNetworkBytes = size_t{kMostNetworkWords} * 4;

// An IPv4 address, high byte first, as programs write it: 192.168.1.12 is 0xC0A8010C.
struct Endpoint {
  uint32_t address = 0;
  uint16_t port = 0;
};

enum WindowsError : int32_t {
  kWindowsFault = 10014, // bad address of data
  kWindowsInvalid = 10022,
  kWindowsUnreachable = 10051, // not a loopback address
  kWindowsReset = 10054,
  kWindowsTimeout = 10060,
  kWindowsRefused = 10061,      // no listener
  kWindowsDisconnected = 10101, // the other side has closed the connection
};

struct Received {
  size_t bytes = 0; // 0 for a stream: its end
  int32_t error = 0;
  bool nothing = false; // neither data nor an error
  Endpoint from;        // sender of a datagram
};

struct Sent {
  size_t bytes = 0;
  int32_t error = 0; // 0 with 0 bytes: no room now
};

class Line {
public:
  virtual ~Line() = default;

  // Each of these functions closes what is open and returns 0, or an error, after which the line is closed. `port`: own
  // port.
  virtual int32_t openUdp(uint16_t port) = 0;
  virtual int32_t listen(uint16_t port) = 0;
  // Connects in the background; `connected` returns the result. `settleMs`: longest time to wait for it.
  virtual int32_t connect(Endpoint to, int settleMs) = 0;
  // Returns 0 or an error; nothing: still connecting.
  virtual std::optional<int32_t> connected() = 0;
  // After `listen`, while no client is connected: accepts the next client that waits.
  virtual void accept() = 0;
  // Whether data can be sent and received: UDP, or a stream that this side has not closed.
  virtual bool isOpen() const = 0;
  virtual void close() = 0;
  // Closes only the connection; a listener continues to listen.
  virtual void closeConnection() = 0;

  // Receives a datagram, whose bytes beyond the end of `to` are lost, or at most `to` bytes of a stream. `peek` does
  // not remove them.
  virtual Received receive(std::span<uint8_t> to, bool peek) = 0;
  virtual Sent send(std::span<const uint8_t> from) = 0;
  virtual Sent sendTo(std::span<const uint8_t> from, Endpoint to) = 0;
};

// A network in memory with two members, the control and its device, each with its own ports. Data sent by one can be
// received by the other at once and in order. Addresses are ignored, because there is no other device.

// Sent bytes that have not been received yet.
class Inbox {
public:
  size_t used() const { return used_; }
  size_t room() const { return bytes_.size() - used_; }
  void push(std::span<const uint8_t> from); // at most `room` bytes
  size_t copy(std::span<uint8_t> to) const; // copies the oldest bytes and returns their number
  void drop(size_t count);                  // at most `used` bytes
  void clear() { used_ = 0; }

  template <class Archive>
  void state(Archive& archive) {
    archive.atMost(used_, bytes_.size());
    for (size_t i = 0; i < used_; ++i) archive(bytes_[(begin_ + i) % bytes_.size()]);
  }

private:
  std::array<uint8_t, size_t{16} * 1024> bytes_{}; // room for eleven of the longest messages
  size_t begin_ = 0;
  size_t used_ = 0;
};

class MemoryLine final : public Line {
public:
  MemoryLine() = default;
  MemoryLine(const MemoryLine&) = delete;
  MemoryLine& operator=(const MemoryLine&) = delete;
  // Joins both sides permanently; to be called before their first use.
  static void join(MemoryLine& a, MemoryLine& b);

  int32_t openUdp(uint16_t port) override;
  int32_t listen(uint16_t port) override;
  int32_t connect(Endpoint to, int settleMs) override; // succeeds or is refused at once
  std::optional<int32_t> connected() override { return isOpen() ? 0 : kWindowsRefused; }
  void accept() override;
  bool isOpen() const override { return role_ == Role::Udp || current().open; }
  void close() override;
  void closeConnection() override;

  Received receive(std::span<uint8_t> to, bool peek) override;
  Sent send(std::span<const uint8_t> from) override; // 10054 once the other side has closed
  // A datagram for a closed port, or for an inbox without room, is lost, as with UDP.
  Sent sendTo(std::span<const uint8_t> from, Endpoint to) override;

  // Of this side; the other one has its own.
  template <class Archive>
  void state(Archive& archive) {
    archive(role_, port_);
    archive.atMost(current_, ends_.size() - 1);
    for (End& end : ends_) {
      uint32_t peer = end.peer == nullptr ? kNoPeer : static_cast<uint32_t>(end.peer - other_->ends_.data());
      archive.atMost(peer, kNoPeer);
      archive(end.open, end.inbox);
      if constexpr (Archive::kLoads) end.peer = peer == kNoPeer ? nullptr : &other_->ends_[peer];
    }
  }

private:
  static constexpr uint32_t kNoPeer = 2; // after the two ends
  enum class Role : uint8_t { None, Udp, Server, Client };
  struct DatagramHeader {
    uint16_t bytes = 0;
    uint16_t port = 0; // of the sender
  };
  // This side of a connection; UDP uses only `inbox`.
  struct End {
    bool open = false;
    End* peer = nullptr; // null: closed by the other side
    Inbox inbox;
  };

  static void closeEnd(End& end);
  End& current() { return ends_[current_]; }
  const End& current() const { return ends_[current_]; }
  End& next() { return ends_[1 - current_]; } // of a server: an incoming connection that is not yet accepted
  Received receiveDatagram(std::span<uint8_t> to, bool peek);

  MemoryLine* other_ = nullptr;
  Role role_ = Role::None;
  uint16_t port_ = 0;
  std::array<End, 2> ends_;
  size_t current_ = 0;
};

} // namespace rung::sim::nct
