// Sockets that are closed with their objects, and the listening socket of a server.
#pragma once
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace rung::host {

class Socket {
public:
  explicit Socket(int number = -1) noexcept : number_(number) {}
  Socket(Socket&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Socket& operator=(Socket&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Socket() {
    if (number_ >= 0) close(number_);
  }
  int number() const noexcept { return number_; }

private:
  int number_;
};

// The listening socket of a server, for one thread. If the system has no file descriptor for another client, poll would
// report at once, again and again, that one waits; the socket is therefore not polled for one turn.
class Listener {
public:
  explicit Listener(Socket socket) noexcept : socket_(std::move(socket)) {}

  // For the poll of the next turn.
  pollfd awaited() noexcept { return {std::exchange(pauses_, false) ? -1 : socket_.number(), POLLIN, 0}; }
  // Accepts a waiting client. Returns a socket without a number if the client has disconnected again, or the system has
  // no file descriptor for it.
  Socket accept() noexcept {
    Socket made(accept4(socket_.number(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    pauses_ = made.number() < 0 && errno != EAGAIN && errno != ECONNABORTED;
    return made;
  }

private:
  Socket socket_;
  bool pauses_ = false;
};

} // namespace rung::host
