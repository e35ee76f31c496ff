// The requests that rungctl can send to a program that runs between the pins of a host (docs/control-protocol.md): the
// table of all requests, and the work of the parts that answer them in each turn of the service thread.
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

// Service thread. Commands go to the scan thread; the service thread waits for their results.
class Controller final : public Handler {
public:
  // `image` is the program that the host started with. `log`, which must outlive this object, receives the reports of
  // the program and its host, and every change that a client has made.
  Controller(std::string host, host::PlcHost& plc, const Image& image, Log& log,
             std::unique_ptr<Programs> programs = programsOfMachine());
  ~Controller() override; // must run before the plc is destroyed
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

  // Also writes messages to this file. To be called before the first turn.
  void keepHistory(const std::string& path) { messages_.keepHistory(path); }
  // Sets a function that adds members to the host's status. To be called before the first request.
  void addToStatus(std::function<void(nlohmann::json&)> add) { status_.addToStatus(std::move(add)); }

  // Sets the simulated control around the program: `act` is called in the scan thread, executes an event of the
  // control, and returns "" or an error message. To be called before the first request.
  using Event = std::function<std::string(const std::string& name, const nlohmann::json& keys)>;
  void setSimulation(Event act) { simulation_ = std::move(act); }

  nlohmann::json greeting() override { return status_.greeting(); }
  nlohmann::json answer(const Peer& peer, const nlohmann::json& request) override;
  void gone(const Peer& peer) override;

  // Called in each turn, before the requests of clients: serves the plc, and reports its faults and restarts and the
  // program's messages. `sink` is null if there are no clients.
  void serveProgram(Sink* sink);
  // Called after them: sends changed values to the clients that watch, the program's requests to the client that serves
  // it, and the answer to each client whose force is finished; compares recorded runs of a shadow.
  void serveClients(Sink& sink);

private:
  struct Request;
  static const Request kRequests[];

  const Request& requestOf(const nlohmann::json& request) const;
  nlohmann::json stop(const Peer& peer, const nlohmann::json& request);
  nlohmann::json start(const Peer& peer, const nlohmann::json& request);
  nlohmann::json reset(const Peer& peer, const nlohmann::json& request);
  nlohmann::json clearProfile(const Peer& peer, const nlohmann::json& request);
  nlohmann::json mark(const Peer& peer, const nlohmann::json& request);
  nlohmann::json keep(const Peer& peer, const nlohmann::json& request);
  nlohmann::json recording(const Peer& peer, const nlohmann::json& request);
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
  Event simulation_;      // empty: no simulation
  uint32_t restarts_ = 0; // restarts of the plc when messages were last reported
};

} // namespace rung::control
