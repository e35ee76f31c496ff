// Sources that a client sends, and the program that is compiled of them in a process of its own: one at a time, of one
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

// For the thread that answers requests, which never waits here. The answers are those of docs/control-protocol.md; what
// cannot be done throws Refused.
class CompileService {
public:
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

  uint32_t owner_ = 0; // number of the client; 0: nobody
  Clock::time_point lastUse_;
  std::string packed_;
  std::unique_ptr<compile::Compilation> compilation_;
  std::optional<Image> image_;
  std::string refused_; // why the image could not be loaded
};

} // namespace rung::control
