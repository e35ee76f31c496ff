// Requests of the program that are answered from outside: by whoever is connected to the host's socket for that.
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

// For the thread that serves the plc. What nobody answers in time is refused as where no CNC is there.
class Services {
public:
  static constexpr std::chrono::seconds kPatience{5};

  explicit Services(host::PlcHost& plc) : plc_(plc) {}

  // The commands of docs/control-protocol.md; they throw Refused.
  nlohmann::json serve(const Peer& peer, const nlohmann::json& request);
  nlohmann::json live(const Peer& peer, const nlohmann::json& request);
  nlohmann::json served(const Peer& peer, const nlohmann::json& request);

  void gone(const Peer& peer);
  // Passes new requests on, and refuses those that have waited too long. A provider that has promised a sign of life
  // and gives none counts as gone: what moved has stopped, and it must learn of it before anything moves again.
  void work(Sink& sink);
  // What the operator should know, since it was asked last.
  std::vector<std::string> takeReports() { return std::exchange(reports_, {}); }
  // A request of this peer, of whatever kind, is a sign of life.
  void heard(const Peer& peer);

private:
  struct Waiting {
    rung_request request;
    bool reads;
    int64_t endNs;
  };
  void checkProvider(const Peer& peer) const;
  void checkService(Sink& sink);
  void pass(Sink& sink, const rung_request& request);
  void refuseLate();
  void refuse(uint32_t ticket);

  host::PlcHost& plc_;
  void lose(const std::string& why);
  uint32_t provider_ = 0; // its number as a peer; 0: there is none
  int64_t aliveNs_ = 0;   // that it may be silent; 0: for any time
  int64_t heardNs_ = 0;
  bool isLost_ = false; // it was served, and is no more: what was under way is not done
  std::vector<std::string> reports_;
  std::map<uint32_t, Waiting> waiting_; // by ticket
};

} // namespace rung::control
