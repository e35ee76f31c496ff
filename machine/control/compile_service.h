// Where a controller gets other programs from: compiled files, code with forced cells, and sources that a client sends.
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

// Files, and the compiler process of the machine; a test has them made already.
class Programs {
public:
  virtual ~Programs() = default;
  // A compiled program; throws rung::Error where it cannot be loaded.
  virtual Image open(const std::string& path) = 0;
  // From now on code with forced cells can be had for a program of this image (rung_forces_new).
  virtual void serveForces(const Image& image) = 0;
  // What is being made is not wanted any more.
  virtual void abandon() = 0;
};

std::unique_ptr<Programs> programsOfMachine();

// Sources that a client sends, and the program that is compiled of them in a process of its own: one at a time, of one
// client at a time.
// For the thread that answers requests, which never waits here. The answers are those of docs/control-protocol.md; what
// cannot be done throws Refused.
class CompileService {
public:
  explicit CompileService(PlcAccess& plc) : plc_(plc) {}

  nlohmann::json sources(const Peer& peer, const nlohmann::json& request);
  nlohmann::json compile(const Peer& peer, const nlohmann::json& request);
  nlohmann::json compiled(const Peer& peer, const nlohmann::json& request);
  // What the client's sources have become; throws Refused where they have not been compiled.
  const Image& image(const Peer& peer) const;
  // Its process ends, too.
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
  std::string refused_; // why the image could not be loaded
};

} // namespace rung::control
