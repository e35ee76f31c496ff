// Replaces the running program: reload, rollback, and a shadow, which shows the effect of a new program before it takes
// over.
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
#include "machine/control/program_tables.h"
#include "machine/control/server.h"
#include "rung/runtime.hpp"

namespace rung::control {

// The name of an enum rung_rung_change_kind in answers.
const char* rungChangeName(uint32_t kind);

// Service thread. Throws Refused for requests that cannot be executed.
class Changes {
public:
  Changes(PlcAccess& plc, Cells& cells, Forces& forces, ProgramTables& tables, const CompileService& compiler,
          Programs& programs)
      : plc_(plc), cells_(cells), forces_(forces), tables_(tables), compiler_(compiler), programs_(programs) {}

  // Requests of docs/control-protocol.md.
  nlohmann::json reload(const Peer& peer, const nlohmann::json& request);
  nlohmann::json rollback(const Peer& peer, const nlohmann::json& request);
  nlohmann::json shadow(const Peer& peer, const nlohmann::json& request);
  nlohmann::json compared(const Peer& peer, const nlohmann::json& request);

  void gone(const Peer& peer);
  // Compares recorded runs of the shadow, at most kMostShadowRuns per turn.
  void compareShadow();
  // Ends the comparison: a stopped program records nothing more.
  void programStopped();

private:
  struct NextProgram { // the program that a request names
    std::optional<Image> opened;
    const Image* image = nullptr;
    std::string text; // for users
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
  ProgramTables& tables_;
  const CompileService& compiler_;
  Programs& programs_;
  std::unique_ptr<rung_replacement, Ends<rung_replacement, rung_replacement_free>> replacement_; // the last reload
  std::unique_ptr<rung_shadow, Ends<rung_shadow, rung_shadow_free>> shadow_;
  uint32_t shadowsFor_ = 0; // peer that started the last shadow
  nlohmann::json compared_; // report of the last shadow, once it has ended; null before
};

} // namespace rung::control
