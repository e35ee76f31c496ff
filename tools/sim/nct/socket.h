// Non-blocking sockets of the simulated network. They stay on the loopback: whatever address a program gives, nothing
// leaves this machine. Errors are those of Windows Sockets, which the control reports (man. l.3975).
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace rung::sim::nct {

// An IPv4 address, the first byte the highest, as a program writes it: 192.168.1.12 is 0xC0A8010C.
struct Endpoint {
  uint32_t address = 0;
  uint16_t port = 0;
};

enum WindowsError : int32_t {
  kWindowsFault = 10014, // a bad address of data
  kWindowsInvalid = 10022,
  kWindowsUnreachable = 10051,  // not on the loopback
  kWindowsDisconnected = 10101, // the other side has closed the connection
};

class Socket {
public:
  Socket() = default;
  ~Socket() { close(); }
  Socket(Socket&& other) noexcept;
  Socket& operator=(Socket&& other) noexcept;

  // Each gives 0 or an error; then the socket is closed.
  int32_t openUdp(Endpoint own);
  int32_t listen(Endpoint own);
  // Connects in the background: `connected` says when.
  int32_t connect(Endpoint own, Endpoint to);
  // Nothing: still connecting.
  std::optional<int32_t> connected();
  // A connection that has come in, closed when there is none.
  Socket accept();
  void close();
  bool isOpen() const { return fd_ >= 0; }

  // Waits for data, a connection or room; at most `ms`.
  bool readable(int ms) const;
  bool writable(int ms) const;

  struct Received {
    size_t bytes = 0;
    int32_t error = 0;
    bool nothing = false; // neither data nor an error
    Endpoint from;
  };
  // A datagram, what is beyond the end of `to` is lost; or what the stream has, at most `to`.
  Received receive(std::span<uint8_t> to, bool peek = false);
  struct Sent {
    size_t bytes = 0;
    int32_t error = 0; // 0 and 0 bytes: no room now
  };
  Sent send(std::span<const uint8_t> from);
  Sent sendTo(std::span<const uint8_t> from, Endpoint to);

  uint16_t port() const; // own

private:
  int32_t open(int type, Endpoint own);
  int fd_ = -1;
};

} // namespace rung::sim::nct
