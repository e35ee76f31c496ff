// What is to be known of a host: the state of its program, its pins, and what the rungs have cost. Nothing is changed.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "machine/control/plc_access.h"
#include "machine/control/server.h"

namespace rung::control {

// For the thread that serves the plc. What cannot be done throws Refused.
class Status {
public:
  // `host`: its name. `dialect`: of all programs that it can have.
  Status(PlcAccess& plc, std::string host, std::string dialect)
      : plc_(plc), host_(std::move(host)), dialect_(std::move(dialect)) {}

  // What the host adds to its status. Before the first request.
  void addToStatus(std::function<void(nlohmann::json&)> add) { addToStatus_ = std::move(add); }

  // Answers of docs/control-protocol.md.
  nlohmann::json greeting() const;
  nlohmann::json status(const Peer& peer, const nlohmann::json& request);
  nlohmann::json map(const Peer& peer, const nlohmann::json& request);
  // Of a program that was built with --profile.
  nlohmann::json profile(const Peer& peer, const nlohmann::json& request);

private:
  std::vector<host::Value> pinValues();
  std::vector<rung_profile> counters();

  PlcAccess& plc_;
  std::string host_;
  std::string dialect_;
  std::function<void(nlohmann::json&)> addToStatus_;
};

} // namespace rung::control
