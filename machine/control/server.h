// A non-blocking connection that carries lines of bounded length between two processes.
#pragma once
#include <cstdint>
#include <list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <sys/types.h>

#include "machine/host/socket.h"

namespace rung::control {

class Connection {
public:
  static constexpr size_t kLongestRequest = size_t{64} << 10;
  static constexpr size_t kLongestAnswer = size_t{4} << 20; // and the longest backlog of unsent bytes

  // `longest` is the longest line that it accepts.
  Connection(host::Socket socket, size_t longest) : socket_(std::move(socket)), longest_(longest) {}

  int socket() const { return socket_.number(); }
  // The peer has disconnected or broken the protocol: `problem` is the reason. Nothing more is read or sent.
  bool ended() const { return ended_; }
  const std::string& problem() const { return problem_; }
  bool wantsToSend() const { return !ended_ && !out_.empty(); }

  // Reads the available bytes.
  void receive();
  bool hasLine() const { return in_.find('\n') != std::string::npos; }
  // The next complete line, without its line end.
  std::optional<std::string> line();
  // Queues a line, and sends as much as the socket takes.
  void send(std::string_view line);
  void sendMore();
  // Ends the connection once the queued lines are sent.
  void end(std::string problem);

private:
  host::Socket socket_;
  size_t longest_;
  bool ended_ = false;
  std::string problem_;
  std::string in_, out_;
};

// Destination of a host's answers and events: the clients of a socket, or a test.

class Sink {
public:
  virtual ~Sink() = default;
  // Sends an event to the client with this number; drops it if that client has disconnected.
  virtual void send(uint32_t peer, const nlohmann::json& event) = 0;
  // Sends an answer that the handler has deferred. Until then no further request of the client is processed.
  virtual void answer(uint32_t peer, const nlohmann::json& answer) = 0;
};

// The socket of a host: its user, and root, may send requests, one JSON object per line (docs/control-protocol.md).

constexpr int kProtocol = 1;

// A client, with the identity that the system reports.
struct Peer {
  uint32_t number = 0; // number of the connection, from 1, never reused
  uid_t user = 0;
  pid_t process = 0;
  std::string name; // of the user; the user's number if there is no name
};

class Handler {
public:
  virtual ~Handler() = default;
  // The first line that the host sends.
  virtual nlohmann::json greeting() = 0;
  // The answer to one request, any JSON; null: it follows later through Sink::answer.
  virtual nlohmann::json answer(const Peer& peer, const nlohmann::json& request) = 0;
  virtual void gone(const Peer& peer) = 0;
};

// Used by one thread.
class Server final : public Sink {
public:
  static constexpr size_t kMostPeers = 16;

  // Listens at the socket of this host. Throws std::runtime_error if the path is not usable, or another host has it.
  Server(const std::string& host, uid_t user, Handler& handler);
  ~Server() override; // removes the socket
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Appends the sockets to be polled. Returns true if a complete request is already here.
  bool awaits(std::vector<pollfd>& sockets);
  // Evaluates these sockets after the poll: answers one request of each client.
  void serve(std::span<const pollfd> sockets);
  void send(uint32_t peer, const nlohmann::json& event) override;
  void answer(uint32_t peer, const nlohmann::json& answer) override;
  const std::string& path() const { return path_; }

private:
  struct Client {
    Peer peer;
    Connection connection;
    bool waits = false; // for a deferred answer
    bool hasRequest() const { return !waits && connection.hasLine(); }
  };
  void accept(host::Socket made);
  void read(Client& client);
  void forget();

  std::string path_;
  uid_t user_;
  Handler& handler_;
  host::Listener listening_;
  uint32_t lastPeer_ = 0;
  std::list<Client> clients_;
};

} // namespace rung::control
