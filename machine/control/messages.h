// What the program and its host report, and the requests for it: each report becomes an entry of the log, and is sent
// to the clients that follow.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "machine/control/log.h"
#include "machine/control/server.h"
#include "machine/host/plc_host.h"

namespace rung::control {

// Service thread. `sink` is null if there are no clients.
class Messages {
public:
  Messages(host::PlcHost& plc, Log& log) : plc_(plc), log_(log) {}
  ~Messages(); // must run before the plc is destroyed
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  // The requests of docs/control-protocol.md.
  nlohmann::json messages(const Peer& peer, const nlohmann::json& request);
  nlohmann::json acknowledge(const Peer& peer, const nlohmann::json& request);
  nlohmann::json log(const Peer& peer, const nlohmann::json& request);
  void gone(const Peer& peer);

  void report(const host::Report& report, Sink* sink);
  // A report of the host that is neither a fault nor a restart.
  void report(const std::string& text, Sink* sink) { report({.text = text}, sink); }
  // The program has been switched on again, so none of its messages is on.
  void programRestarted(Sink* sink);
  // Called in each turn, after the plc was served: reports the program's messages, at most kMostMessages, and writes
  // the log to its file.
  void work(Sink* sink);

private:
  void passMessages(Sink* sink);
  void pass(const rung_message_info& message, Sink* sink);
  void tellFollowers(Sink* sink, const char* event, const std::string& text, bool logged);
  void sendEntries(Sink& sink);

  host::PlcHost& plc_;
  Log& log_;
  std::vector<uint32_t> following_;           // numbers of peers that follow the messages
  std::map<uint32_t, uint64_t> followingLog_; // of peers that follow the log: the last version that they have got
};

} // namespace rung::control
