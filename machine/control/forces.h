// Cells that clients force: the set of all forces, and a change of it for which the compiler is still making code.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "machine/control/cells.h"
#include "machine/control/compile_service.h"
#include "machine/control/plc_access.h"
#include "machine/control/server.h"
#include "rung/runtime.hpp"

namespace rung::control {

// Service thread. Throws Refused for requests that cannot be executed.
class Forces {
public:
  Forces(PlcAccess& plc, const Cells& cells, Programs& programs);
  ~Forces();
  Forces(const Forces&) = delete;
  Forces& operator=(const Forces&) = delete;

  // Requests of docs/control-protocol.md. A null answer follows later, from finishPending.
  nlohmann::json force(const Peer& peer, const nlohmann::json& request);
  nlohmann::json unforce(const Peer& peer, const nlohmann::json& request);
  nlohmann::json forced(const Peer& peer, const nlohmann::json& request);

  void gone(const Peer& peer);
  // Answers the pending change once its code has been made, or was refused.
  void finishPending(Sink& sink);
  // Refuses the pending change: the event that `why` describes has ended all forces.
  void refusePending(const std::string& why);

  std::vector<std::string> activeNames();
  // The program has been replaced: code with forced cells of the previous one is no longer needed.
  void programChanged() { forces_.reset(); }
  // Returns, and forgets, the names of the cells that were last known to be forced, when all forces have ended; "":
  // none.
  std::string takeEndedNames();
  // The same as text for the end of a log line.
  std::string endedForces();

private:
  struct HeldCell;
  struct Change;
  using ForceSet = std::unique_ptr<rung_forces, Ends<rung_forces, rung_forces_free>>;

  std::vector<HeldCell> heldCells();
  // The force of the same cell, whatever its name there is; null if there is none.
  const HeldCell* forceOf(const std::vector<HeldCell>& held, const std::string& name) const;
  void refuseWhilePending() const;
  std::optional<ForceSet> prepared(const Change& change);
  void putInEffect(const Change& change, ForceSet forces);
  nlohmann::json begin(Change change);

  PlcAccess& plc_;
  const Cells& cells_;
  Programs& programs_;
  std::vector<std::string> heldNames_;
  std::unique_ptr<Change> pending_; // the change for which code is being made
  ForceSet forces_;
};

} // namespace rung::control
