// The control's way to other programs on this machine: sockets at 127.0.0.1.
#pragma once
#include "sim/nct/socket.h"

namespace rung::sim::nct {

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
