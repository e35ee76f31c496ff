// The device on the network (see network_device.h).
#include "sim/nct/network_device.h"

#include <cstring>

namespace rung::sim::nct {

std::string NetworkDevice::open(std::string_view role, uint16_t port) {
  messageBytes_ = 0;
  udp_ = role == "udp";
  if (udp_) return line_.openUdp(port), "";
  if (role == "server") return line_.listen(port), "";
  if (role != "client") return "event device: open=\"udp\", \"server\" or \"client\"";
  return line_.connect({0, port}, 0) == 0 ? "" : "no server listens on port " + std::to_string(port);
}

// WORDS words; those that the event does not name are 0.
std::string NetworkDevice::send(const std::vector<NcArgument>& keys, uint16_t control) {
  const int64_t words = integerKey(keys, "send", 0);
  if (words < 1 || words > kMostNetworkWords) return "event device: send=1 to 350 words";
  std::array<uint8_t, kMostNetworkBytes> bytes{};
  for (const NcArgument& key : keys) {
    if (key.key == "send" || key.key == "port") continue;
    const auto number = numbersAfter(key.key, "w");
    if (!number || number->size() != 1 || (*number)[0] >= words) return "event device does not know '" + key.key + "'";
    const auto word = static_cast<uint32_t>(key.integer);
    std::memcpy(bytes.data() + size_t{4} * (*number)[0], &word, sizeof word);
  }
  poll();
  if (!line_.isOpen()) return "the device has no connection";
  const std::span<const uint8_t> message(bytes.data(), static_cast<size_t>(words) * 4);
  const Sent sent = udp_ ? line_.sendTo(message, {0, control}) : line_.send(message);
  if (sent.error != 0) return "the device cannot send: the control has closed the connection";
  return sent.bytes == message.size() ? "" : "the device cannot send: the control has not received what it sent before";
}

std::string NetworkDevice::event(const std::vector<NcArgument>& keys, uint16_t control) {
  const int64_t port = integerKey(keys, "port", 0);
  if (port < 0 || port > 65535) return "event device: port=1 to 65535";
  if (const NcArgument* role = findKey(keys, "open")) {
    const uint16_t opened = port != 0 ? static_cast<uint16_t>(port) : control;
    return opened == 0 ? "event device: open needs port=N" : open(role->text, opened);
  }
  if (findKey(keys, "send") != nullptr) return send(keys, control);
  if (findKey(keys, "close") == nullptr) return "event device takes open, send or close";
  close();
  return {};
}

void NetworkDevice::poll() {
  line_.accept();
  std::array<uint8_t, kMostNetworkBytes> bytes{};
  while (line_.isOpen()) {
    const Received received = line_.receive(bytes, false);
    if (received.nothing) return;
    if (received.bytes == 0) return line_.closeConnection();
    std::memcpy(message_.data(), bytes.data(), received.bytes);
    messageBytes_ = received.bytes;
  }
}

std::optional<double> NetworkDevice::receivedWord(uint32_t number) const {
  if (number >= receivedWords()) return std::nullopt;
  int32_t word = 0;
  std::memcpy(&word, message_.data() + size_t{4} * number, sizeof word);
  return word;
}

} // namespace rung::sim::nct
