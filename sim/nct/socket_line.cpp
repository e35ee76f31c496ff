// Sockets at 127.0.0.1 (see socket_line.h).
#include "sim/nct/socket_line.h"

namespace rung::sim::nct {
namespace {

constexpr uint32_t kHome = 0x7F000001;

} // namespace

int32_t SocketLine::openUdp(uint16_t port) {
  close();
  return socket_.openUdp({kHome, port});
}

int32_t SocketLine::listen(uint16_t port) {
  close();
  return listener_.listen({kHome, port});
}

int32_t SocketLine::connect(Endpoint to, int settleMs) {
  close();
  const int32_t error = socket_.connect({kHome, 0}, to);
  if (error == 0 && settleMs > 0) socket_.writable(settleMs);
  return error;
}

void SocketLine::accept() {
  if (!socket_.isOpen()) socket_ = listener_.accept();
}

void SocketLine::close() {
  listener_.close();
  socket_.close();
}

} // namespace rung::sim::nct
