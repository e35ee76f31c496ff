// Access of all parts of the controller to the running program: commands to its scan thread, and a log line for every
// change by a user.
#pragma once
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "machine/control/log.h"
#include "machine/control/server.h"
#include "machine/host/plc_host.h"

namespace rung::control {

// A client as the log names it.
LogEntry::Person personOf(const Peer& peer);

// Service thread, which waits for the scan thread while a command is executed.
class PlcAccess {
public:
  PlcAccess(host::PlcHost& host, Log& log) : host_(host), log_(log) {}

  host::PlcHost& host() const { return host_; }
  rung_instance* instance() const { return host_.instance(); }
  rung_program_info program() const; // the running program

  // Returns the command with its results; throws Refused if it was not executed.
  host::Command post(host::Command command, std::chrono::milliseconds time = host::PlcHost::kPatience);
  // Nothing if no thread scans the program.
  std::optional<rung_state> state();
  std::vector<rung_force_info> activeForces();

  void logChange(const Peer& peer, LogKind kind, const std::string& text);

  static constexpr uint32_t kMostForces = 64;

private:
  host::PlcHost& host_;
  Log& log_;
};

} // namespace rung::control
