// Compiles, in a separate process, the sources that a client of the host's socket sends: one program at a time, for one
// client at a time.
#pragma once
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "machine/compile/compilation.h"
#include "machine/control/server.h"
#include "rung/runtime.hpp"

namespace rung::control {

// Service thread; no function waits. The answers are described in docs/control-protocol.md; a request that cannot be
// carried out throws Refused.
class CompileService {
public:
  nlohmann::json sources(const Peer& peer, const nlohmann::json& request);
  nlohmann::json compile(const Peer& peer, const nlohmann::json& request);
  nlohmann::json compiled(const Peer& peer, const nlohmann::json& request);
  // The program compiled from the client's sources; throws Refused if they have not been compiled.
  const Image& image(const Peer& peer) const;
  // The client has disconnected: its compiler process is ended.
  void gone(const Peer& peer);

private:
  using Clock = std::chrono::steady_clock;
  void takePlace(const Peer& peer);
  void begin(uint32_t owner);
  void load();
  void require(const Peer& peer) const;

  uint32_t owner_ = 0; // number of the client; 0: none
  Clock::time_point lastUse_;
  std::string packed_;
  std::unique_ptr<compile::Compilation> compilation_;
  std::optional<Image> image_;
  std::string refused_; // why the image could not be loaded
};

} // namespace rung::control
