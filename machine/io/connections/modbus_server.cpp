// See modbus_server.h. Sockets and the limits of clients are handled here; libmodbus, which would wait for the rest of
// a message, executes only complete, checked requests.
#include "machine/io/connections/modbus_server.h"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "rtlib/run/realtime.h"

namespace rung::io {
namespace {

constexpr int kTurnMs = 20; // time that a turn waits for clients
constexpr double kBurstSeconds = 0.02;

struct Address {
  sockaddr_storage bytes{};
  socklen_t size = 0;
};

Address addressOf(const host::Connection& connection) {
  Address address;
  auto* four = reinterpret_cast<sockaddr_in*>(&address.bytes);
  if (inet_pton(AF_INET, connection.host.c_str(), &four->sin_addr) == 1) {
    four->sin_family = AF_INET;
    four->sin_port = htons(connection.port);
    address.size = sizeof *four;
    return address;
  }
  auto* six = reinterpret_cast<sockaddr_in6*>(&address.bytes);
  inet_pton(AF_INET6, connection.host.c_str(), &six->sin6_addr);
  six->sin6_family = AF_INET6;
  six->sin6_port = htons(connection.port);
  address.size = sizeof *six;
  return address;
}

host::Socket listenAt(const host::Connection& connection) {
  const Address address = addressOf(connection);
  host::Socket made(socket(address.bytes.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int yes = 1;
  setsockopt(made.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (bind(made.number(), reinterpret_cast<const sockaddr*>(&address.bytes), address.size) == 0 &&
      listen(made.number(), SOMAXCONN) == 0)
    return made;
  std::string text = connection.title() + ": cannot listen: " + std::strerror(errno);
  if (errno == EACCES) text += "; ports below 1024 need rights: write for example port = 1502";
  if (errno == EADDRINUSE) text += "; another program has this port: end it, or write another port";
  throw std::runtime_error(text);
}

void sendAtOnce(int socket) {
  const int yes = 1;
  setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

// Whether there is room for a complete answer: the kernel reports it while a third of the buffer is free, which is not
// the case for a client that does not read its answers.
bool hasRoom(int socket) {
  pollfd asked{socket, POLLOUT, 0};
  return poll(&asked, 1, 0) == 1 && asked.revents == POLLOUT;
}

} // namespace

ModbusServer::ModbusServer(const host::Connection& connection, Exchange& exchange)
    : mostClients_(connection.connections), requestsPerNs_(connection.requests / 1e9),
      burst_(std::max(1.0, connection.requests * kBurstSeconds)), exchange_(exchange), image_(exchange),
      context_(modbus_new_tcp(nullptr, connection.port)), listening_(listenAt(connection)) {
  if (context_ == nullptr) throw std::bad_alloc();
}

void ModbusServer::run(const std::atomic<bool>& ending) noexcept {
  while (!ending) try {
      turn();
    } catch (const std::bad_alloc&) {
      setProblem("there is not enough memory for a client");
    }
}

void ModbusServer::turn() {
  std::vector<pollfd> waiting = {listening_.awaited()};
  for (const Client& client : clients_) // clients without allowance are not read
    waiting.push_back({client.socket.number(), static_cast<short>(client.allowance >= 1 ? POLLIN : 0), 0});
  poll(waiting.data(), waiting.size(), waitFor());
  const int64_t now = runtime::monotonicNs();
  auto event = waiting.begin() + 1;
  for (Client& client : clients_) serve(client, (event++)->revents, now);
  clients_.remove_if([](const Client& client) { return client.ended; });
  if (waiting.front().revents != 0) accept(now);
}

// In milliseconds; short while a client waits for its next request.
int ModbusServer::waitFor() const {
  const auto waits = [this](const Client& client) { return client.allowance < 1 || hasMessage(client); };
  return std::ranges::any_of(clients_, waits) ? 1 : kTurnMs;
}

void ModbusServer::accept(int64_t now) {
  host::Socket made = listening_.accept();
  if (made.number() < 0) return;
  makeRoom(now);
  if (clients_.size() >= mostClients_)
    return setProblem("a client was refused: the maximum number of clients is connected");
  sendAtOnce(made.number());
  Client& client = clients_.emplace_back();
  client.socket = std::move(made);
  client.heardNs = client.refilledNs = now;
}

// Drops the quietest client if it is silent: a client whose cable was unplugged sends nothing any more.
void ModbusServer::makeRoom(int64_t now) {
  if (clients_.size() < mostClients_) return;
  const auto quietest = std::ranges::min_element(clients_, {}, &Client::heardNs);
  if (now - quietest->heardNs > exchange_.timeoutNs()) clients_.erase(quietest);
}

// Answers one message, so that other clients get their turn.
void ModbusServer::serve(Client& client, int events, int64_t now) {
  client.ended = (events & ~POLLIN) != 0;
  refill(client, now);
  if (events == POLLIN && !hasMessage(client)) receive(client, now);
  if (!client.ended && client.allowance >= 1 && hasMessage(client)) answer(client, now);
  // The rest of a message must arrive within the timeout.
  if (client.size != 0 && !hasMessage(client) && now - client.heardNs > exchange_.timeoutNs()) client.ended = true;
}

void ModbusServer::refill(Client& client, int64_t now) const {
  const double earned = static_cast<double>(now - client.refilledNs) * requestsPerNs_;
  client.allowance = std::min(burst_, client.allowance + earned);
  client.refilledNs = now;
}

void ModbusServer::receive(Client& client, int64_t now) {
  const ssize_t got =
      recv(client.socket.number(), client.bytes.data() + client.size, client.bytes.size() - client.size, 0);
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (got <= 0) return void(client.ended = true);
  if (client.size == 0) client.heardNs = now; // a new message begins
  client.size += static_cast<size_t>(got);
  if (!messageLength({client.bytes.data(), client.size})) {
    setProblem("a client sent what is not a request of Modbus TCP");
    client.ended = true;
  }
}

bool ModbusServer::hasMessage(const Client& client) const {
  const size_t length = messageLength({client.bytes.data(), client.size}).value_or(0);
  return length != 0 && client.size >= length;
}

void ModbusServer::answer(Client& client, int64_t now) {
  const size_t length = messageLength({client.bytes.data(), client.size}).value_or(0);
  client.allowance -= 1;
  client.heardNs = now;
  client.ended = !reply(client, static_cast<int>(length), now);
  client.size -= length;
  std::memmove(client.bytes.data(), client.bytes.data() + length, client.size);
  if (!messageLength({client.bytes.data(), client.size})) client.ended = true;
}

// Returns false if the client does not accept the answer.
bool ModbusServer::reply(const Client& client, int length, int64_t now) {
  Request request;
  Exception wrong = parseRequest({client.bytes.data(), static_cast<size_t>(length)}, request);
  if (wrong == Exception::None) wrong = image_.check(request);
  if (!hasRoom(client.socket.number())) return false;
  modbus_set_socket(context_.get(), client.socket.number());
  if (wrong != Exception::None)
    return modbus_reply_exception(context_.get(), client.bytes.data(), static_cast<unsigned>(wrong)) > 0;
  // Values written before a silence have expired, as for the program.
  if (now - writtenNs_ > exchange_.timeoutNs()) image_.resetInputs();
  if (!request.writes) image_.refreshOutputs();
  const bool taken = modbus_reply(context_.get(), client.bytes.data(), length, image_.tables()) > 0;
  published(request.writes, now);
  return taken;
}

// If there are inputs, only writing clients keep the connection alive: another client may continue to read.
void ModbusServer::published(bool wrote, int64_t now) {
  if (!wrote && !exchange_.inputs().empty()) return;
  writtenNs_ = now;
  exchange_.publish(image_.inputs(), now);
}

} // namespace rung::io
