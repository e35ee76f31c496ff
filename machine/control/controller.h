// What rungctl may ask of a program that runs between the pins of a host (docs/control-protocol.md): the table of all
// requests, and what the parts that answer them do in each turn of the thread that serves.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "machine/control/cells.h"
#include "machine/control/changes.h"
#include "machine/control/compile_service.h"
#include "machine/control/forces.h"
#include "machine/control/log.h"
#include "machine/control/messages.h"
#include "machine/control/plc_access.h"
#include "machine/control/server.h"
#include "machine/control/services.h"
#include "machine/control/status.h"
#include "machine/host/plc_host.h"
#include "rung/runtime.hpp"

namespace rung::control {

// For the thread that serves the plc; commands go to the scan thread, which it waits for.
class Controller final : public Handler {
public:
  // `image` is what the host began with. `log`, which outlives this, gets what the program and its host report, and
  // every change that a client has made.
  Controller(std::string host, host::PlcHost& plc, const Image& image, Log& log,
             std::unique_ptr<Programs> programs = programsOfMachine());
  ~Controller() override; // before the plc
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

  // Messages are kept in this file, too. Before the first turn.
  void keepHistory(const std::string& path) { messages_.keepHistory(path); }
  // What the host adds to its status. Before the first request.
  void addToStatus(std::function<void(nlohmann::json&)> add) { status_.addToStatus(std::move(add)); }

  // A simulated control around the program: `act` does an event of it, in the scan thread, and says what is wrong.
  // Before the first request.
  using Event = std::function<std::string(const std::string& name, const nlohmann::json& keys)>;
  void setSimulation(Event act) { simulation_ = std::move(act); }

  nlohmann::json greeting() override { return status_.greeting(); }
  nlohmann::json answer(const Peer& peer, const nlohmann::json& request) override;
  void gone(const Peer& peer) override;

  // In each turn of the thread, before the requests of clients: what the plc needs from time to time and reports then,
  // and what the program has shown. `sink`: null where there are no clients.
  void serveProgram(Sink* sink);
  // After them: sends what has changed to those who watch, the program's questions to the client that serves it, and
  // the answer to each client whose force is done; compares what a shadow has recorded, for a part of a turn.
  void serveClients(Sink& sink);

private:
  struct Request;
  static const Request kRequests[];

  const Request& requestOf(const nlohmann::json& request) const;
  nlohmann::json stop(const Peer& peer, const nlohmann::json& request);
  nlohmann::json start(const Peer& peer, const nlohmann::json& request);
  nlohmann::json reset(const Peer& peer, const nlohmann::json& request);
  nlohmann::json clearProfile(const Peer& peer, const nlohmann::json& request);
  nlohmann::json event(const Peer& peer, const nlohmann::json& request);
  nlohmann::json simple(host::Command::Kind kind, const Peer& peer, const char* what);

  PlcAccess plc_;
  std::unique_ptr<Programs> programs_;
  Status status_;
  Messages messages_;
  Cells cells_;
  CompileService compiler_;
  Forces forces_;
  Changes changes_;
  Services services_;
  Event simulation_;      // empty: there is none
  uint32_t restarts_ = 0; // of the plc, when messages were noted
};

} // namespace rung::control
