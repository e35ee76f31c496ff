// What the program and its host report: each line goes to the log, is kept for those who ask later, and is sent to
// those who follow.
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

// For the thread that serves the plc; null for `sink`: there are no clients.
class Messages {
public:
  Messages(host::PlcHost& plc, Log& log) : plc_(plc), log_(log) {}
  ~Messages(); // before the plc
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  // They are kept in this file, too. Before the first turn.
  void keepHistory(const std::string& path) { historyFile_ = std::make_unique<HistoryFile>(history_, path); }

  // The answer of docs/control-protocol.md.
  nlohmann::json messages(const Peer& peer, const nlohmann::json& request);
  void gone(const Peer& peer) { std::erase(following_, peer.number); }

  void report(const std::string& text, Sink* sink);
  // The program has been switched on again: none of its messages is on.
  void programRestarted(Sink* sink);
  // In each turn, once the plc has been served: what the program has shown, as much as fits into it; the history goes
  // to its file.
  void work(Sink* sink);

private:
  void passMessages(Sink* sink);
  void pass(const rung_message_info& message, Sink* sink);
  void tellFollowers(Sink* sink, const char* event, const std::string& text, bool logged);
  void writeHistory(Sink* sink);

  host::PlcHost& plc_;
  Log& log_;
  History history_;
  std::unique_ptr<HistoryFile> historyFile_; // null: it is in memory alone
  std::vector<uint32_t> following_;          // peers
};

} // namespace rung::control
