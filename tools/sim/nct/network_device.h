// The other side of the simulated network: a device that scenarios open, close and make send (`event device …`). It
// talks to the control through real sockets, and has an address of its own on the loopback.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "tools/sim/nct/socket.h"
#include "tools/sim/nct/topic.h"

namespace rung::sim::nct {

inline constexpr uint32_t kMostNetworkWords = 350; // of a message (l.4029)

class NetworkDevice {
public:
  // Keys of the event: open=udp|server|client with port=N; send=WORDS with w0=V …; close=1. `control` is where the
  // control's own side listens.
  std::string event(const std::vector<NcArgument>& keys, Endpoint own, Endpoint links);
  void close();

  // The last message that came: its length, its words.
  uint32_t receivedWords();
  std::optional<double> receivedWord(uint32_t number);
  bool connected();

private:
  enum class Role : uint8_t { None, Udp, Server, Client };
  std::string open(std::string_view role, Endpoint own, Endpoint links);
  std::string send(const std::vector<NcArgument>& keys, Endpoint links);
  void poll();

  Role role_ = Role::None;
  Socket listener_;
  Socket socket_;
  std::array<uint8_t, kMostNetworkWords * 4> message_{};
  size_t messageBytes_ = 0;
};

} // namespace rung::sim::nct
