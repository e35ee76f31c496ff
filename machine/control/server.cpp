// See server.h.
#include "machine/control/server.h"

#include <nlohmann/json.hpp>
#include <poll.h>
#include <pwd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "machine/control/place.h"

namespace rung::control {

namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& path) {
  throw std::runtime_error("cannot listen at " + path + ": " + std::strerror(errno));
}

std::string nameOf(uid_t user) {
  std::array<char, 4096> buffer{};
  passwd entry{};
  passwd* found = nullptr;
  if (getpwuid_r(user, &entry, buffer.data(), buffer.size(), &found) == 0 && found != nullptr) return found->pw_name;
  return std::to_string(user);
}

std::string textOf(const json& line) { return line.dump(-1, ' ', false, json::error_handler_t::replace); }

// Stacks of hosts are small, and JSON is written recursively.
bool isDeep(std::string_view line) {
  constexpr int kMostLevels = 8;
  int levels = 0;
  bool inText = false;
  for (size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (inText && c == '\\')
      ++i;
    else if (c == '"')
      inText = !inText;
    else if (!inText && (c == '[' || c == '{') && ++levels > kMostLevels)
      return true;
    else if (!inText && (c == ']' || c == '}'))
      --levels;
  }
  return false;
}

json problemOf(const std::string& text) { return {{"ok", false}, {"error", text}}; }

} // namespace

Server::Server(const std::string& host, uid_t user, Handler& handler) : user_(user), handler_(handler) {
  if (const std::string wrong = wrongHostName(host); !wrong.empty()) throw std::runtime_error(wrong);
  path_ = socketPath(prepareFolder(user), host);
  const sockaddr_un address = socketAddress(path_);
  if (const std::string another = socketOf(user, host); isServed(another))
    throw std::runtime_error(another + ": another host is called " + host + "; choose another name");
  unlink(path_.c_str()); // of a host that was killed
  socket_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket_ < 0) refuse(path_);
  // Every user who may use the folder can connect; then the user is checked.
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      chmod(path_.c_str(), 0600) != 0 || listen(socket_, static_cast<int>(kMostPeers)) != 0) {
    close(socket_);
    refuse(path_);
  }
}

Server::~Server() {
  close(socket_);
  unlink(path_.c_str());
}

void Server::serve(std::chrono::milliseconds wait) {
  std::vector<pollfd> waiting = {{std::exchange(pauses_, false) ? -1 : socket_, POLLIN, 0}};
  const bool hasRequests = std::ranges::any_of(clients_, &Client::hasRequest);
  if (hasRequests) wait = std::chrono::milliseconds(0);
  for (const Client& client : clients_) {
    const int events = (client.waits ? POLLRDHUP : POLLIN) | (client.connection.wantsToSend() ? POLLOUT : 0);
    waiting.push_back({client.connection.socket(), static_cast<short>(events), 0});
  }
  if (poll(waiting.data(), waiting.size(), static_cast<int>(wait.count())) <= 0 && !hasRequests) return;
  auto event = waiting.begin() + 1;
  for (Client& client : clients_) {
    if ((event->revents & POLLOUT) != 0) client.connection.sendMore();
    const bool isCalled = (event->revents & ~POLLOUT) != 0;
    if (isCalled && client.waits)
      client.connection.end("the client did not wait for its answer");
    else if (isCalled || client.hasRequest())
      read(client);
    ++event;
  }
  if (waiting.front().revents != 0) accept();
  forget();
}

void Server::accept() {
  const int made = accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  pauses_ = made < 0 && errno != EAGAIN && errno != ECONNABORTED;
  if (made < 0) return;
  Client client{{.number = ++lastPeer_}, Connection(made, Connection::kLongestRequest)};
  ucred who{};
  socklen_t size = sizeof who;
  const bool known = getsockopt(made, SOL_SOCKET, SO_PEERCRED, &who, &size) == 0;
  client.peer.user = who.uid;
  client.peer.process = who.pid;
  client.peer.name = nameOf(who.uid);
  if (!known || (who.uid != user_ && who.uid != 0))
    return client.connection.send(problemOf("only the user who has started the host, and root, may use it").dump());
  if (clients_.size() == kMostPeers)
    return client.connection.send(
        problemOf("the host serves " + std::to_string(kMostPeers) + " others already").dump());
  client.connection.send(handler_.greeting().dump());
  clients_.push_back(std::move(client));
}

// A line at a time: others ask, too.
void Server::read(Client& client) {
  client.connection.receive();
  const std::optional<std::string> line = client.connection.line();
  if (!line) return;
  if (isDeep(*line)) return client.connection.send(problemOf("found more than 8 levels in the request").dump());
  const json request = json::parse(*line, nullptr, false);
  const json answer = request.is_discarded() ? problemOf("found a line that is not JSON, expected an object")
                                             : handler_.answer(client.peer, request);
  client.waits = answer.is_null();
  if (!client.waits) client.connection.send(textOf(answer));
}

void Server::forget() {
  for (auto client = clients_.begin(); client != clients_.end();) {
    if (client->connection.ended()) {
      handler_.gone(client->peer);
      client = clients_.erase(client);
    } else {
      ++client;
    }
  }
}

void Server::send(uint32_t peer, const json& event) {
  for (Client& client : clients_)
    if (client.peer.number == peer) client.connection.send(textOf(event));
}

void Server::answer(uint32_t peer, const json& answer) {
  for (Client& client : clients_)
    if (client.peer.number == peer) client.waits = false;
  send(peer, answer);
}

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

// At most one line more than is taken at a time: a client that sends too much waits in its own buffers.
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
