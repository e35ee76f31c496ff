// The other side of the simulated network: a device that scenarios open, close and make send (`event device …`).
#pragma once
#include <array>
#include <string>
#include <vector>

#include "sim/nct/memory_line.h"
#include "sim/nct/topic.h"

namespace rung::sim::nct {

class NetworkDevice {
public:
  // The device's side of the wire, joined with the control's.
  explicit NetworkDevice(MemoryLine& line) : line_(line) {}

  // Keys of the event: open=udp|server|client with port=N; send=WORDS with w0=V …; close=1. `control` is the port of
  // the control's connection, 0: it has none; `open` without a port takes it.
  std::string event(const std::vector<NcArgument>& keys, uint16_t control);
  void close() { line_.close(); }
  // Takes what the control has sent.
  void poll();

  // The last message that came: its length, its words.
  uint32_t receivedWords() const { return static_cast<uint32_t>(messageBytes_ / 4); }
  std::optional<double> receivedWord(uint32_t number) const;
  bool connected() const { return line_.isOpen(); }

private:
  std::string open(std::string_view role, uint16_t port);
  std::string send(const std::vector<NcArgument>& keys, uint16_t control);

  MemoryLine& line_;
  bool udp_ = false; // what was opened last
  std::array<uint8_t, kMostNetworkBytes> message_{};
  size_t messageBytes_ = 0;
};

} // namespace rung::sim::nct
