// The device on the network (see network_device.h).
#include "tools/sim/nct/network_device.h"

#include <cstring>

namespace rung::sim::nct {
namespace {

constexpr int kPatienceMs = 200; // for the other side; the loopback answers at once

std::string opened(int32_t error) {
  return error == 0 ? std::string() : "the device cannot open its port: error " + std::to_string(error);
}

} // namespace

void NetworkDevice::close() {
  role_ = Role::None;
  listener_.close();
  socket_.close();
}

std::string NetworkDevice::open(std::string_view role, Endpoint own, Endpoint links) {
  close();
  messageBytes_ = 0;
  if (role == "udp") {
    role_ = Role::Udp;
    return opened(socket_.openUdp(own));
  }
  if (role == "server") {
    role_ = Role::Server;
    return opened(listener_.listen(own));
  }
  if (role != "client") return "event device: open=\"udp\", \"server\" or \"client\"";
  role_ = Role::Client;
  own.port = 0;
  if (const int32_t error = socket_.connect(own, links)) return opened(error);
  socket_.writable(kPatienceMs);
  const std::optional<int32_t> done = socket_.connected();
  return done && *done == 0 ? std::string() : "nobody listens on port " + std::to_string(links.port);
}

// WORDS words; those that the event does not name are 0.
std::string NetworkDevice::send(const std::vector<NcArgument>& keys, Endpoint links) {
  const int64_t words = integerKey(keys, "send", 0);
  if (words < 1 || words > kMostNetworkWords) return "event device: send=1 to 350 words";
  std::array<uint8_t, kMostNetworkWords * 4> bytes{};
  for (const NcArgument& key : keys) {
    if (key.key == "send" || key.key == "port") continue;
    const auto number = numbersBehind(key.key, "w");
    if (!number || number->size() != 1 || (*number)[0] >= words) return "event device does not know '" + key.key + "'";
    const auto word = static_cast<uint32_t>(key.integer);
    std::memcpy(bytes.data() + size_t{4} * (*number)[0], &word, sizeof word);
  }
  poll();
  if (!socket_.isOpen()) return "the device has no connection";
  const std::span<const uint8_t> message(bytes.data(), static_cast<size_t>(words) * 4);
  const Socket::Sent sent = role_ == Role::Udp ? socket_.sendTo(message, links) : socket_.send(message);
  return sent.bytes == message.size() ? std::string() : "the device cannot send: error " + std::to_string(sent.error);
}

std::string NetworkDevice::event(const std::vector<NcArgument>& keys, Endpoint own, Endpoint links) {
  const int64_t port = integerKey(keys, "port", 0);
  if (port < 0 || port > 65535) return "event device: port=1 to 65535";
  if (port != 0) own.port = static_cast<uint16_t>(port);
  const NcArgument* role = findKey(keys, "open");
  if (role != nullptr && port != 0) links.port = static_cast<uint16_t>(port);
  if (role != nullptr) return own.port == 0 ? "event device: open needs port=N" : open(role->text, own, links);
  if (findKey(keys, "send") != nullptr) return send(keys, links);
  if (findKey(keys, "close") == nullptr) return "event device takes open, send or close";
  close();
  return {};
}

void NetworkDevice::poll() {
  if (role_ == Role::Server && !socket_.isOpen()) socket_ = listener_.accept();
  std::array<uint8_t, kMostNetworkWords * 4> bytes;
  while (socket_.isOpen()) {
    const Socket::Received received = socket_.receive(bytes);
    if (received.nothing) return;
    if (received.error != 0 || (received.bytes == 0 && role_ != Role::Udp)) return socket_.close();
    std::memcpy(message_.data(), bytes.data(), received.bytes);
    messageBytes_ = received.bytes;
  }
}

uint32_t NetworkDevice::receivedWords() {
  (socket_.isOpen() ? socket_ : listener_).readable(messageBytes_ == 0 ? kPatienceMs : 0);
  poll();
  return static_cast<uint32_t>(messageBytes_ / 4);
}

std::optional<double> NetworkDevice::receivedWord(uint32_t number) {
  if (number >= receivedWords()) return std::nullopt;
  int32_t word = 0;
  std::memcpy(&word, message_.data() + size_t{4} * number, sizeof word);
  return word;
}

bool NetworkDevice::connected() {
  poll();
  return socket_.isOpen();
}

} // namespace rung::sim::nct
