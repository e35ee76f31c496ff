// Requests of the program that are answered from outside: by whoever is connected to the host's socket for that.
#pragma once
#include <chrono>
#include <functional>
#include <map>

#include <nlohmann/json_fwd.hpp>

#include "tools/plc/box.h"
#include "tools/remote/server.h"
#include "tools/services/translate.h"

namespace rung::remote {

// For the thread that serves the box. What nobody answers in time is refused as where no CNC is there.
class Services {
public:
  static constexpr std::chrono::seconds kPatience{5};

  explicit Services(plc::Box& box) : box_(box) {}

  // The commands of docs/control-protocol.md; they throw Refused.
  nlohmann::json serve(const Peer& peer);
  nlohmann::json live(const Peer& peer, const nlohmann::json& request);
  nlohmann::json served(const Peer& peer, const nlohmann::json& request);

  void gone(const Peer& peer);
  // Passes new requests on, and refuses those that have waited too long.
  void work(Server& server);

private:
  struct Waiting {
    services::Request request;
    std::chrono::steady_clock::time_point end;
  };
  void checkProvider(const Peer& peer) const;
  void pass(Server& server, services::Request request);
  void refuseLate();
  void refuse(const services::Request& request);

  plc::Box& box_;
  uint32_t provider_ = 0;               // its number as a peer; 0: there is none
  std::map<uint32_t, Waiting> waiting_; // by ticket
};

} // namespace rung::remote
