// See connection.h.
#include "machine/control/connection.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace rung::control {

Connection::Connection(Connection&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), longest_(other.longest_), ended_(other.ended_),
      problem_(std::move(other.problem_)), in_(std::move(other.in_)), out_(std::move(other.out_)) {}

Connection& Connection::operator=(Connection&& other) noexcept {
  std::swap(socket_, other.socket_);
  std::swap(longest_, other.longest_);
  std::swap(ended_, other.ended_);
  std::swap(problem_, other.problem_);
  std::swap(in_, other.in_);
  std::swap(out_, other.out_);
  return *this;
}

Connection::~Connection() {
  if (socket_ >= 0) close(socket_);
}

void Connection::end(std::string problem) {
  ended_ = true;
  problem_ = std::move(problem);
}

// At most one line more than is taken at a time: whoever floods us waits in their own buffers.
void Connection::receive() {
  char bytes[16384];
  while (!ended_ && in_.size() <= longest_) {
    const ssize_t got = recv(socket_, bytes, sizeof bytes, MSG_DONTWAIT);
    if (got > 0)
      in_.append(bytes, static_cast<size_t>(got));
    else if (got < 0 && errno == EINTR)
      continue;
    else if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK))
      return;
    else
      return hasLine() ? void() : end("the other side has ended the connection"); // it may have sent before
  }
}

std::optional<std::string> Connection::line() {
  const size_t length = in_.find('\n');
  if (length == std::string::npos) {
    if (in_.size() > longest_) end("a line is longer than " + std::to_string(longest_) + " bytes");
    return std::nullopt;
  }
  std::string line = in_.substr(0, length);
  in_.erase(0, length + 1);
  return line;
}

void Connection::send(std::string_view line) {
  if (ended_) return;
  if (out_.size() + line.size() > kLongestAnswer) return end("the other side does not read its data");
  out_ += line;
  out_ += '\n';
  sendMore();
}

void Connection::sendMore() {
  while (!ended_ && !out_.empty()) {
    const ssize_t sent = ::send(socket_, out_.data(), out_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0)
      out_.erase(0, static_cast<size_t>(sent));
    else if (sent < 0 && errno == EINTR)
      continue;
    else if (sent < 0 && (errno == EAGAIN || errno == EWOULDBLOCK))
      return;
    else
      return end("the other side has ended the connection");
  }
}

} // namespace rung::control
