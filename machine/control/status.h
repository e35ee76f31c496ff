// Read-only reports about a host: the state of its program, its pins, and the profile of its rungs.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "machine/control/plc_access.h"
#include "machine/control/server.h"

namespace rung::control {

// Service thread. Throws Refused for requests that cannot be executed.
class Status {
public:
  // `host`: name of the host. `dialect`: of all programs that it can run.
  Status(PlcAccess& plc, std::string host, std::string dialect)
      : plc_(plc), host_(std::move(host)), dialect_(std::move(dialect)) {}

  // Sets a function that adds members to the host's status. To be called before the first request.
  void addToStatus(std::function<void(nlohmann::json&)> add) { addToStatus_ = std::move(add); }

  // Requests of docs/control-protocol.md.
  nlohmann::json greeting() const;
  nlohmann::json status();
  nlohmann::json map(const Peer& peer, const nlohmann::json& request);
  // The timers that run.
  nlohmann::json timers(const Peer& peer, const nlohmann::json& request);
  // Counters of a program that was built with --profile.
  nlohmann::json profile(const Peer& peer, const nlohmann::json& request);

private:
  struct PinValues {
    std::vector<host::Value> values; // empty: no thread scans the program
    std::unique_ptr<bool[]> overwritten;
  };
  PinValues pinValues();
  std::vector<rung_timer_info> runningTimers();
  std::vector<rung_profile> counters();

  PlcAccess& plc_;
  std::string host_;
  std::string dialect_;
  std::function<void(nlohmann::json&)> addToStatus_;
};

} // namespace rung::control
