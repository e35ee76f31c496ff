// Non-blocking sockets of the simulated network. They only use the loopback: nothing leaves this machine, whatever
// address a program specifies. Errors are those of Windows Sockets.
#pragma once
#include "sim/nct/memory_line.h"

namespace rung::sim::nct {

class Socket {
public:
  Socket() = default;
  ~Socket() { close(); }
  Socket(Socket&& other) noexcept;
  Socket& operator=(Socket&& other) noexcept;

  // Each of these functions returns 0, or an error, after which the socket is closed.
  int32_t openUdp(Endpoint own);
  int32_t listen(Endpoint own);
  // Connects in the background; `connected` returns the result.
  int32_t connect(Endpoint own, Endpoint to);
  // Nothing: still connecting.
  std::optional<int32_t> connected();
  // Accepts an incoming connection; the socket is closed if there is none.
  Socket accept();
  void close();
  bool isOpen() const { return fd_ >= 0; }

  // Waits for data, a connection or room, at most `ms` milliseconds.
  bool readable(int ms) const;
  bool writable(int ms) const;

  // Receives a datagram, whose bytes beyond the end of `to` are lost, or at most `to` bytes of a stream.
  Received receive(std::span<uint8_t> to, bool peek = false);
  Sent send(std::span<const uint8_t> from);
  Sent sendTo(std::span<const uint8_t> from, Endpoint to);

  uint16_t port() const; // own port

private:
  int32_t open(int type, Endpoint own);
  int fd_ = -1;
};

// The control's connection to other programs on this machine: sockets at 127.0.0.1.

class SocketLine final : public Line {
public:
  int32_t openUdp(uint16_t port) override;
  int32_t listen(uint16_t port) override;
  int32_t connect(Endpoint to, int settleMs) override;
  std::optional<int32_t> connected() override { return socket_.connected(); }
  void accept() override;
  bool isOpen() const override { return socket_.isOpen(); }
  void close() override;
  void closeConnection() override { socket_.close(); }

  Received receive(std::span<uint8_t> to, bool peek) override { return socket_.receive(to, peek); }
  Sent send(std::span<const uint8_t> from) override { return socket_.send(from); }
  Sent sendTo(std::span<const uint8_t> from, Endpoint to) override { return socket_.sendTo(from, to); }

private:
  Socket listener_;
  Socket socket_;
};

} // namespace rung::sim::nct
