// Cells that clients force: the set of all forces, and a change of it whose code the compiler is at work on.
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

// For the thread that serves the plc. What cannot be done throws Refused.
class Forces {
public:
  Forces(PlcAccess& plc, const Cells& cells, Programs& programs);
  ~Forces();
  Forces(const Forces&) = delete;
  Forces& operator=(const Forces&) = delete;

  // Answers of docs/control-protocol.md; null: it comes by finishPending.
  nlohmann::json force(const Peer& peer, const nlohmann::json& request);
  nlohmann::json unforce(const Peer& peer, const nlohmann::json& request);
  nlohmann::json forced(const Peer& peer, const nlohmann::json& request);

  void gone(const Peer& peer);
  // Answers the change whose code is made, or that is refused.
  void finishPending(Sink& sink);
  // What has happened meanwhile ends forces, too.
  void refusePending(const std::string& why);

  std::vector<std::string> activeNames();
  // Another program has taken over: what was forced in the one before is not needed any more.
  void programChanged() { forces_.reset(); }
  // Names of the cells that were forced, as far as this thread has heard, as it hears that they are no more; "": none.
  std::string takeEndedNames();
  // The same at the end of a line of the log.
  std::string endedForces();

private:
  struct HeldCell;
  struct Change;
  using ForceSet = std::unique_ptr<rung_forces, Ends<rung_forces, rung_forces_free>>;

  std::vector<HeldCell> heldCells();
  void refuseWhilePending() const;
  std::optional<ForceSet> prepared(const Change& change);
  void putInEffect(const Change& change, ForceSet forces);
  nlohmann::json begin(Change change);

  PlcAccess& plc_;
  const Cells& cells_;
  Programs& programs_;
  std::vector<std::string> heldNames_;
  std::unique_ptr<Change> pending_; // for whose code the compiler is at work
  ForceSet forces_;
};

} // namespace rung::control
