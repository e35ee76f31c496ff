// Requests of the program to its CNC, answered by a client of the host's socket.
#pragma once
#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "machine/control/server.h"
#include "machine/host/plc_host.h"
#include "machine/host/services.h"

namespace rung::control {

// Service thread. A request that is not answered in time is refused as if there were no CNC.
class Services {
public:
  static constexpr std::chrono::seconds kPatience{5};

  explicit Services(host::PlcHost& plc) : plc_(plc) {}

  // Requests of docs/control-protocol.md; they throw Refused.
  nlohmann::json serve(const Peer& peer, const nlohmann::json& request);
  nlohmann::json live(const Peer& peer, const nlohmann::json& request);
  nlohmann::json served(const Peer& peer, const nlohmann::json& request);

  void gone(const Peer& peer);
  // Passes new requests to the provider, and refuses those that have waited too long. A provider that has promised
  // signs of life and sends none counts as disconnected: all motion has stopped, and the program must learn of it
  // before anything moves again.
  void work(Sink& sink);
  // The requests that wait for an answer, for `status`: `count`, `oldest`.
  nlohmann::json waiting() const;
  // Takes the reports for the operator since the last call.
  std::vector<std::string> takeReports() { return std::exchange(reports_, {}); }
  // Any request of this peer is a sign of life.
  void heard(const Peer& peer);

private:
  struct Waiting {
    rung_request request;
    host::Operation operation;
    int64_t sinceNs; // when it was passed to the provider
    int64_t endNs;
  };
  void checkProvider(const Peer& peer) const;
  void checkService(Sink& sink);
  void pass(Sink& sink, const rung_request& request);
  void refuseLate();
  void refuse(uint32_t ticket);

  host::PlcHost& plc_;
  void lose(const std::string& why);
  uint32_t provider_ = 0; // number of the serving peer; 0: none
  int64_t aliveNs_ = 0;   // longest silence; 0: without limit
  int64_t heardNs_ = 0;
  bool isLost_ = false; // the provider has disconnected: its requests in progress are not done
  std::vector<std::string> reports_;
  std::map<uint32_t, Waiting> waiting_; // by ticket
};

} // namespace rung::control
