// The socket of a host: its user, and root, may send requests, one JSON object a line (docs/control-protocol.md).
#pragma once
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <list>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "machine/control/connection.h"
#include "machine/control/sink.h"

namespace rung::control {

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
  ~Server() override; // nothing is left of the socket
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Answers what has come; waits for it no longer than that.
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
  bool pauses_ = false; // the system had no file for another client: for a turn none is asked for
  uint32_t lastPeer_ = 0;
  std::list<Client> clients_;
};

} // namespace rung::control
