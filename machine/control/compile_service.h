// The sources of new programs for a controller: compiled files, code with forced cells, and source texts that a client
// sends.
#pragma once
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "machine/compile/compilation.h"
#include "machine/control/plc_access.h"
#include "machine/control/server.h"
#include "rung/runtime.hpp"

namespace rung::control {

// Access to files and to the compiler process of this machine; tests replace it by programs that are already compiled.
class Programs {
public:
  virtual ~Programs() = default;
  // Loads a compiled program. Throws rung::Error if it cannot be loaded.
  virtual Image open(const std::string& path) = 0;
  // From now on rung_forces_new can get code with forced cells for the program of this image.
  virtual void serveForces(const Image& image) = 0;
  // Cancels the compilation in progress.
  virtual void abandon() = 0;
};

std::unique_ptr<Programs> programsOfMachine();

// Compiles sources that a client sends in a separate process: one compilation at a time, for one client at a time.
// Service thread, which never waits here. The requests are those of docs/control-protocol.md; throws Refused for those
// that cannot be executed.
class CompileService {
public:
  explicit CompileService(PlcAccess& plc) : plc_(plc) {}

  nlohmann::json sources(const Peer& peer, const nlohmann::json& request);
  nlohmann::json compile(const Peer& peer, const nlohmann::json& request);
  nlohmann::json compiled(const Peer& peer, const nlohmann::json& request);
  // The program compiled from the client's sources; throws Refused if there is none.
  const Image& image(const Peer& peer) const;
  // Ends the client's compiler process, too.
  void gone(const Peer& peer);

private:
  using Clock = std::chrono::steady_clock;
  void takePlace(const Peer& peer);
  void begin(uint32_t owner);
  void load();
  void require(const Peer& peer) const;

  PlcAccess& plc_;
  uint32_t owner_ = 0; // number of the client; 0: none
  Clock::time_point lastUse_;
  std::string packed_;
  std::unique_ptr<compile::Compilation> compilation_;
  std::optional<Image> image_;
  std::string refused_; // reason why the image could not be loaded
};

} // namespace rung::control
