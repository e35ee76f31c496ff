// The way of the simulated control, or of its device, into a network: one connection at a time. Errors are those of
// Windows Sockets, which the control reports (man. l.3975). Nothing here waits, unless it says so, or allocates.
#pragma once
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
  kWindowsRefused = 10061,      // nobody listens there
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
  // After `listen`, while nobody is connected: accepts the next client that waits.
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

} // namespace rung::sim::nct
