// See server.h.
#include "machine/control/server.h"

#include <nlohmann/json.hpp>
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

// Threads of hosts have small stacks, and JSON is written recursively.
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

// The socket path for a host with this name; creates its folder.
std::string placeOf(const std::string& host, uid_t user) {
  if (const std::string wrong = wrongHostName(host); !wrong.empty()) throw std::runtime_error(wrong);
  std::string path = socketPath(prepareFolder(user), host);
  if (const std::string another = socketOf(user, host); isServed(another))
    throw std::runtime_error(another + ": another host is called " + host + "; choose another name");
  return path;
}

host::Socket listenAt(const std::string& path) {
  const sockaddr_un address = socketAddress(path);
  unlink(path.c_str()); // left by a host that was killed
  host::Socket made(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (made.number() < 0) refuse(path);
  // Any user with access to the folder may be able to connect; the identity of each client is checked after that.
  if (bind(made.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      chmod(path.c_str(), 0600) != 0 || listen(made.number(), static_cast<int>(Server::kMostPeers)) != 0)
    refuse(path);
  return made;
}

} // namespace

Server::Server(const std::string& host, uid_t user, Handler& handler)
    : path_(placeOf(host, user)), user_(user), handler_(handler), listening_(listenAt(path_)) {}

Server::~Server() { unlink(path_.c_str()); }

bool Server::awaits(std::vector<pollfd>& sockets) {
  sockets.push_back(listening_.awaited());
  for (const Client& client : clients_) {
    const int events = (client.waits ? POLLRDHUP : POLLIN) | (client.connection.wantsToSend() ? POLLOUT : 0);
    sockets.push_back({client.connection.socket(), static_cast<short>(events), 0});
  }
  return std::ranges::any_of(clients_, &Client::hasRequest);
}

void Server::serve(std::span<const pollfd> sockets) {
  auto event = sockets.begin() + 1;
  for (Client& client : clients_) {
    if ((event->revents & POLLOUT) != 0) client.connection.sendMore();
    const bool isCalled = (event->revents & ~POLLOUT) != 0;
    if (isCalled && client.waits)
      client.connection.end("the client did not wait for its answer");
    else if (isCalled || client.hasRequest())
      read(client);
    ++event;
  }
  if (sockets.front().revents != 0) accept(listening_.accept());
  forget();
}

void Server::accept(host::Socket made) {
  if (made.number() < 0) return;
  Client client{{.number = ++lastPeer_}, Connection(std::move(made), Connection::kLongestRequest)};
  ucred who{};
  socklen_t size = sizeof who;
  const bool known = getsockopt(client.connection.socket(), SOL_SOCKET, SO_PEERCRED, &who, &size) == 0;
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

// Answers one line, so that other clients get their turn.
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

void Connection::end(std::string problem) {
  ended_ = true;
  problem_ = std::move(problem);
}

// Buffers at most one line more than is processed: a client that sends too much has to wait.
void Connection::receive() {
  char bytes[16384];
  while (!ended_ && in_.size() <= longest_) {
    const ssize_t got = recv(socket(), bytes, sizeof bytes, MSG_DONTWAIT);
    if (got > 0)
      in_.append(bytes, static_cast<size_t>(got));
    else if (got < 0 && errno == EINTR)
      continue;
    else if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK))
      return;
    else
      return hasLine() ? void() : end("the other side has ended the connection"); // the peer may have sent lines before
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
    const ssize_t sent = ::send(socket(), out_.data(), out_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
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
