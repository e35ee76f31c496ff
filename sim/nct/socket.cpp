// Sockets on the loopback.
#include "sim/nct/socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace rung::sim::nct {

namespace {

constexpr uint32_t kLoopback = 0x7F000000; // 127.0.0.0/8

bool isLoopback(uint32_t address) { return (address & 0xFF000000) == kLoopback; }

int32_t windowsError(int error) {
  switch (error) {
  case 0: return 0;
  case EACCES:
  case EPERM: return 10013;
  case EFAULT: return kWindowsFault;
  case EINVAL: return kWindowsInvalid;
  case EMFILE:
  case ENFILE: return 10024;
  case EAGAIN: return 10035;
  case EMSGSIZE: return 10040;
  case EADDRINUSE: return 10048;
  case EADDRNOTAVAIL: return 10049;
  case ENETDOWN: return 10050;
  case ENETUNREACH: return kWindowsUnreachable;
  case ECONNABORTED: return 10053;
  case ECONNRESET:
  case EPIPE: return kWindowsReset;
  case ENOBUFS: return 10055;
  case ENOTCONN: return 10057;
  case ETIMEDOUT: return kWindowsTimeout;
  case ECONNREFUSED: return kWindowsRefused;
  case EHOSTUNREACH: return 10065;
  default: return kWindowsInvalid;
  }
}

sockaddr_in systemAddress(Endpoint endpoint) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(endpoint.address);
  address.sin_port = htons(endpoint.port);
  return address;
}

const sockaddr* generic(const sockaddr_in& address) { return reinterpret_cast<const sockaddr*>(&address); }
sockaddr* generic(sockaddr_in& address) { return reinterpret_cast<sockaddr*>(&address); }

bool waitFor(int fd, int16_t events, int ms) {
  pollfd entry{fd, events, 0};
  return fd >= 0 && ::poll(&entry, 1, ms) > 0;
}

} // namespace

Socket::Socket(Socket&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

Socket& Socket::operator=(Socket&& other) noexcept {
  if (this == &other) return *this;
  close();
  fd_ = std::exchange(other.fd_, -1);
  return *this;
}

void Socket::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

int32_t Socket::open(int type, Endpoint own) {
  close();
  if (!isLoopback(own.address)) return kWindowsUnreachable;
  fd_ = ::socket(AF_INET, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int on = 1;
  // A server's port can be reused at once; a second server on it is still refused.
  if (fd_ >= 0 && type == SOCK_STREAM) ::setsockopt(fd_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  const sockaddr_in address = systemAddress(own);
  if (fd_ >= 0 && ::bind(fd_, generic(address), sizeof address) == 0) return 0;
  const int32_t error = windowsError(errno);
  close();
  return error;
}

int32_t Socket::openUdp(Endpoint own) { return open(SOCK_DGRAM, own); }

int32_t Socket::listen(Endpoint own) {
  if (const int32_t error = open(SOCK_STREAM, own)) return error;
  if (::listen(fd_, 1) == 0) return 0;
  const int32_t error = windowsError(errno);
  close();
  return error;
}

int32_t Socket::connect(Endpoint own, Endpoint to) {
  if (!isLoopback(to.address)) return kWindowsUnreachable;
  if (const int32_t error = open(SOCK_STREAM, own)) return error;
  const sockaddr_in address = systemAddress(to);
  if (::connect(fd_, generic(address), sizeof address) == 0 || errno == EINPROGRESS) return 0;
  const int32_t error = windowsError(errno);
  close();
  return error;
}

std::optional<int32_t> Socket::connected() {
  if (!writable(0)) return std::nullopt;
  int error = 0;
  socklen_t size = sizeof error;
  ::getsockopt(fd_, SOL_SOCKET, SO_ERROR, &error, &size);
  if (error != 0) close();
  return windowsError(error);
}

Socket Socket::accept() {
  Socket socket;
  if (fd_ >= 0) socket.fd_ = ::accept4(fd_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  return socket;
}

bool Socket::readable(int ms) const { return waitFor(fd_, POLLIN, ms); }
bool Socket::writable(int ms) const { return waitFor(fd_, POLLOUT, ms); }

Received Socket::receive(std::span<uint8_t> to, bool peek) {
  sockaddr_in from{};
  socklen_t size = sizeof from;
  const ssize_t bytes = ::recvfrom(fd_, to.data(), to.size(), peek ? MSG_PEEK : 0, generic(from), &size);
  Received received;
  if (bytes < 0) {
    received.nothing = errno == EAGAIN || errno == EINTR;
    received.error = received.nothing ? 0 : windowsError(errno);
    return received;
  }
  received.bytes = static_cast<size_t>(bytes);
  received.from = {ntohl(from.sin_addr.s_addr), ntohs(from.sin_port)};
  return received;
}

Sent Socket::send(std::span<const uint8_t> from) {
  const ssize_t bytes = ::send(fd_, from.data(), from.size(), MSG_NOSIGNAL);
  if (bytes >= 0) return {static_cast<size_t>(bytes), 0};
  return {0, errno == EAGAIN || errno == EINTR ? 0 : windowsError(errno)};
}

Sent Socket::sendTo(std::span<const uint8_t> from, Endpoint to) {
  if (!isLoopback(to.address)) return {0, kWindowsUnreachable};
  const sockaddr_in address = systemAddress(to);
  const ssize_t bytes = ::sendto(fd_, from.data(), from.size(), MSG_NOSIGNAL, generic(address), sizeof address);
  if (bytes >= 0) return {static_cast<size_t>(bytes), 0};
  return {0, errno == EAGAIN || errno == EINTR ? 0 : windowsError(errno)};
}

uint16_t Socket::port() const {
  sockaddr_in own{};
  socklen_t size = sizeof own;
  if (fd_ < 0 || ::getsockname(fd_, generic(own), &size) != 0) return 0;
  return ntohs(own.sin_port);
}

// Sockets at 127.0.0.1.

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
