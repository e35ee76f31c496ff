// The host's socket: lines of bounded length between two processes, without waiting, and the server that answers them.
#pragma once
#include <chrono>
#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>
#include <sys/types.h>

namespace rung::control {

class Connection {
public:
  static constexpr size_t kLongestRequest = size_t{64} << 10;
  static constexpr size_t kLongestAnswer = size_t{4} << 20; // also the limit of unsent bytes

  // A connection over a socket, which it closes at its end; `longest` is the longest line that it accepts.
  Connection(int socket, size_t longest) : socket_(socket), longest_(longest) {}
  Connection(Connection&& other) noexcept;
  Connection& operator=(Connection&& other) noexcept;
  ~Connection();

  int socket() const { return socket_; }
  // Whether the connection has ended: the other side has closed it, or breaks the rules (`problem` says which). Nothing
  // is read or sent any more.
  bool ended() const { return ended_; }
  const std::string& problem() const { return problem_; }
  bool wantsToSend() const { return !ended_ && !out_.empty(); }

  // Reads what has arrived.
  void receive();
  bool hasLine() const { return in_.find('\n') != std::string::npos; }
  // The next whole line, without its end.
  std::optional<std::string> line();
  // Sends a line, as far as the other side accepts it; sendMore sends the rest.
  void send(std::string_view line);
  void sendMore();
  // Ends the connection after everything has been sent.
  void end(std::string problem);

private:
  int socket_ = -1;
  size_t longest_;
  bool ended_ = false;
  std::string problem_;
  std::string in_, out_;
};

// The receiver of a host's answers and events: the clients of a socket, or a test.

class Sink {
public:
  virtual ~Sink() = default;
  // Sends an event to a client; nothing happens if that client has disconnected.
  virtual void send(uint32_t peer, const nlohmann::json& event) = 0;
  // Sends an answer that a handler has postponed. Until then no further request of the client is read.
  virtual void answer(uint32_t peer, const nlohmann::json& answer) = 0;
};

// The server at a host's socket: its user and root may send requests, one JSON object per line
// (docs/control-protocol.md).

// A client, as the system identifies it.
struct Peer {
  uint32_t number = 0; // of the connection, from 1, never used again
  uid_t user = 0;
  pid_t process = 0;
  std::string name; // of the user; the number if the user has no name
};

class Handler {
public:
  virtual ~Handler() = default;
  // The first line that a client gets.
  virtual nlohmann::json greeting() = 0;
  // The answer to one request, which may be any JSON; null: it follows by Sink::answer.
  virtual nlohmann::json answer(const Peer& peer, const nlohmann::json& request) = 0;
  virtual void gone(const Peer& peer) = 0;
};

// Service thread.
class Server final : public Sink {
public:
  static constexpr size_t kMostPeers = 16;

  // Listens at the socket of this host. Throws std::runtime_error if that is not possible, or another host has it.
  Server(const std::string& host, uid_t user, Handler& handler);
  ~Server() override; // removes the socket
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Answers the requests that have arrived; waits at most `wait` for one.
  void serve(std::chrono::milliseconds wait);
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
  void accept();
  void read(Client& client);
  void forget();

  std::string path_;
  uid_t user_;
  Handler& handler_;
  int socket_ = -1;
  bool pauses_ = false; // the system had no file descriptor for another client: accepts none for a turn
  uint32_t lastPeer_ = 0;
  std::list<Client> clients_;
};

} // namespace rung::control
