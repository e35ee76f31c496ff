// Lines between two processes, of a bounded length, without waiting.
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
  static constexpr size_t kLongestAnswer = size_t{4} << 20; // and the most that waits until the other side takes it

  // `longest` is the longest line that it takes.
  Connection(host::Socket socket, size_t longest) : socket_(std::move(socket)), longest_(longest) {}

  int socket() const { return socket_.number(); }
  // The other side has gone, or breaks the rules: `problem` says which. No more is read or sent.
  bool ended() const { return ended_; }
  const std::string& problem() const { return problem_; }
  bool wantsToSend() const { return !ended_ && !out_.empty(); }

  // Takes what has come.
  void receive();
  bool hasLine() const { return in_.find('\n') != std::string::npos; }
  // The next whole line, without its end.
  std::optional<std::string> line();
  // A line; sent as far as the other side takes it.
  void send(std::string_view line);
  void sendMore();
  // After what is sent.
  void end(std::string problem);

private:
  host::Socket socket_;
  size_t longest_;
  bool ended_ = false;
  std::string problem_;
  std::string in_, out_;
};

// Where a host's answers and events go: to the clients of a socket, or to a test.

class Sink {
public:
  virtual ~Sink() = default;
  // To the client with this number; drops the event if that client has gone.
  virtual void send(uint32_t peer, const nlohmann::json& event) = 0;
  // The answer that a handler has not given before. Until then nothing else that the client sends is looked at.
  virtual void answer(uint32_t peer, const nlohmann::json& answer) = 0;
};

// The socket of a host: its user, and root, may send requests, one JSON object a line (docs/control-protocol.md).

constexpr int kProtocol = 1;

// Who asks, as the system knows them.
struct Peer {
  uint32_t number = 0; // of the connection, from 1, never used again
  uid_t user = 0;
  pid_t process = 0;
  std::string name; // of the user; the number where there is none
};

class Handler {
public:
  virtual ~Handler() = default;
  // What the host says first.
  virtual nlohmann::json greeting() = 0;
  // The answer to one request, any JSON; null: it comes later, by Sink::answer.
  virtual nlohmann::json answer(const Peer& peer, const nlohmann::json& request) = 0;
  virtual void gone(const Peer& peer) = 0;
};

// For one thread.
class Server final : public Sink {
public:
  static constexpr size_t kMostPeers = 16;

  // Listens at the place of this host. Throws std::runtime_error: something is wrong with it, or another host has it.
  Server(const std::string& host, uid_t user, Handler& handler);
  ~Server() override; // nothing is left of its place
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Adds what it waits for, for poll. True: a request is here already.
  bool awaits(std::vector<pollfd>& sockets);
  // These, after that: answers what has come, one request of each client.
  void serve(std::span<const pollfd> sockets);
  void send(uint32_t peer, const nlohmann::json& event) override;
  void answer(uint32_t peer, const nlohmann::json& answer) override;
  const std::string& path() const { return path_; }

private:
  struct Client {
    Peer peer;
    Connection connection;
    bool waits = false; // for an answer
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
