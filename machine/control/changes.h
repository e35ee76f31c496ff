// Another program in the place of the running one: a reload, what it would do as a shadow before, and the way back.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "machine/control/cells.h"
#include "machine/control/compile_service.h"
#include "machine/control/forces.h"
#include "machine/control/plc_access.h"
#include "machine/control/server.h"
#include "rung/runtime.hpp"

namespace rung::control {

// For the thread that serves the plc. What cannot be done throws Refused.
class Changes {
public:
  Changes(PlcAccess& plc, Cells& cells, Forces& forces, const CompileService& compiler, Programs& programs)
      : plc_(plc), cells_(cells), forces_(forces), compiler_(compiler), programs_(programs) {}

  // Answers of docs/control-protocol.md.
  nlohmann::json reload(const Peer& peer, const nlohmann::json& request);
  nlohmann::json rollback(const Peer& peer, const nlohmann::json& request);
  nlohmann::json shadow(const Peer& peer, const nlohmann::json& request);
  nlohmann::json compared(const Peer& peer, const nlohmann::json& request);

  void gone(const Peer& peer);
  // Compares what a shadow has recorded, for a part of a turn.
  void compareShadow();
  // The program has been stopped: nothing more comes that could be compared.
  void programStopped();

private:
  struct NextProgram { // that a request names
    std::optional<Image> opened;
    const Image* image = nullptr;
    std::string text; // for people
    const Image& get() const { return opened ? *opened : *image; }
  };
  NextProgram nextProgram(const Peer& peer, const nlohmann::json& request);
  nlohmann::json putInPlace(rung_replacement* replacement, const std::vector<rung_cell>& dead, nlohmann::json report,
                            const char* why);
  void waitForScan(uint64_t scans);
  void endShadow();
  nlohmann::json shadowReport();
  void finishShadow(nlohmann::json report);

  PlcAccess& plc_;
  Cells& cells_;
  Forces& forces_;
  const CompileService& compiler_;
  Programs& programs_;
  std::unique_ptr<rung_replacement, Ends<rung_replacement, rung_replacement_free>> replacement_; // the last reload
  std::unique_ptr<rung_shadow, Ends<rung_shadow, rung_shadow_free>> shadow_;
  uint32_t shadowsFor_ = 0; // the peer that has begun the last one
  nlohmann::json compared_; // of the last one, once it is over; null before
};

} // namespace rung::control
