// Where a host's answers and events go: to the clients of a socket, or to a test.
#pragma once
#include <cstdint>

#include <nlohmann/json_fwd.hpp>

namespace rung::control {

class Sink {
public:
  virtual ~Sink() = default;
  // To one of those who have asked; to nobody where that one has gone.
  virtual void send(uint32_t peer, const nlohmann::json& event) = 0;
  // The answer that a handler has not given before. Until then nothing else that the client sends is looked at.
  virtual void answer(uint32_t peer, const nlohmann::json& answer) = 0;
};

} // namespace rung::control
