// Reports of the program and its host: each line is written to the log, added to the history for later requests, and
// sent to the clients that follow.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "machine/control/history.h"
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

  // Also writes messages to this file. To be called before the first turn.
  void keepHistory(const std::string& path) { historyFile_ = std::make_unique<HistoryFile>(history_, path); }

  // The request of docs/control-protocol.md.
  nlohmann::json messages(const Peer& peer, const nlohmann::json& request);
  void gone(const Peer& peer) { std::erase(following_, peer.number); }

  void report(const std::string& text, Sink* sink);
  // The program has been switched on again, so none of its messages is on.
  void programRestarted(Sink* sink);
  // Called in each turn, after the plc was served: reports the program's messages, at most kMostMessages, and writes
  // the history to its file.
  void work(Sink* sink);

private:
  void passMessages(Sink* sink);
  void pass(const rung_message_info& message, Sink* sink);
  void tellFollowers(Sink* sink, const char* event, const std::string& text, bool logged);
  void writeHistory(Sink* sink);

  host::PlcHost& plc_;
  Log& log_;
  History history_;
  std::unique_ptr<HistoryFile> historyFile_; // null: the history is only in memory
  std::vector<uint32_t> following_;          // numbers of peers
};

} // namespace rung::control
