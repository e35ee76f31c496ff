// What all parts of the controller do with the program that runs: commands to its scan thread, and a line in the log
// for everything that a person changes.
#pragma once
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "machine/control/log.h"
#include "machine/control/server.h"
#include "machine/host/plc_host.h"

namespace rung::control {

// For the thread that serves the plc; a command waits for the scan thread.
class PlcAccess {
public:
  PlcAccess(host::PlcHost& host, Log& log) : host_(host), log_(log) {}

  host::PlcHost& host() const { return host_; }
  rung_instance* instance() const { return host_.instance(); }
  rung_program_info program() const; // that runs

  // With its results; throws Refused where it is not done.
  host::Command post(host::Command command, std::chrono::milliseconds time = host::PlcHost::kPatience);
  // Nothing while no thread scans the program.
  std::optional<rung_state> state();
  std::vector<rung_force_info> activeForces();

  void logChange(const Peer& peer, const std::string& text);

  static constexpr uint32_t kMostForces = 64;

private:
  host::PlcHost& host_;
  Log& log_;
};

} // namespace rung::control
