// MW 60, 61, MR 62, MW 63.
#include "sim/nct/network.h"

#include <algorithm>
#include <cstring>

namespace rung::sim::nct {

namespace {

constexpr int64_t kConnectUs = 5'000'000; // timeout of a connection attempt
constexpr int kSettleMs = 100;            // real time to wait with a virtual clock, on which the loopback takes no time

} // namespace

bool Network::serves(bool write, uint32_t function) const {
  return write ? function == 60 || function == 61 || function == 63 : function == 62;
}

std::optional<int32_t> Network::service(uint32_t function, Block& block) {
  const int32_t amount = block.amount();
  const bool data = function == 62 || function == 63;
  // The table has words up to 7, the text amounts up to 5: 6 includes the port (l.4029).
  if (function == 60 && amount != 5) return 2;
  if (function == 61 && amount != 1) return 2; // "always 2" below the table (l.3997)
  if (data && (amount < 3 || amount > 6)) return 2;
  if (block.word(2) != 1) return 60;
  if (function == 60) return open(block);
  if (function == 61) {
    close();
    return 0;
  }
  if (block.word(4) < 1 || block.word(4) > static_cast<int32_t>(kMostNetworkWords)) return 64;
  line_->accept(); // accepts a server's client, or the next one after a disconnect
  if (protocol_ == Protocol::None || connecting_) return 63;
  if (function == 62) return receive(block);
  return send(block);
}

// ---- opening and closing -----------------------------------------------------------------------------------------

std::optional<int32_t> Network::open(Block& block) {
  if (connecting_) return connecting(block);
  const int32_t protocol = block.word(4);
  const auto address = static_cast<uint32_t>(block.word(5));
  const int32_t port = block.word(6);
  if (protocol < 1 || protocol > 3 || address == 0 || address == 0xFFFFFFFF || port < 1 || port > 65535) return 66;
  close();
  target_ = address;
  port_ = static_cast<uint16_t>(port);
  int32_t error = 0;
  if (protocol == 1) error = line_->openUdp(port_);
  if (protocol == 2) error = line_->listen(port_);
  if (protocol == 3) error = line_->connect({address, port_}, links().realTime ? 0 : kSettleMs);
  if (error != 0) {
    block.setWord(3, error);
    return 61;
  }
  protocol_ = static_cast<Protocol>(protocol);
  connecting_ = protocol_ == Protocol::Client;
  connectingSince_ = links().nowUs;
  block.setWord(3, 0);
  if (!connecting_) return 0;
  return connecting(block);
}

std::optional<int32_t> Network::connecting(Block& block) {
  std::optional<int32_t> error = line_->connected();
  if (!error && links().nowUs - connectingSince_ < kConnectUs) return std::nullopt;
  connecting_ = false;
  block.setWord(3, error.value_or(kWindowsTimeout));
  if (error && *error == 0) return 0;
  close();
  return 61;
}

void Network::close() {
  protocol_ = Protocol::None;
  connecting_ = false;
  line_->close();
  unsentBytes_ = unsentAt_ = 0;
}

// ---- data --------------------------------------------------------------------------------------------------------

// Optional words of the answer are written only within the program's block (l.4034).
int32_t Network::failed(Block& block, int32_t error) {
  if (block.amount() >= 4) block.setWord(5, error);
  return 62;
}

int32_t Network::receive(Block& block) {
  // Word 0000 has the program's flags.
  if (block.word(3) < 1 || !links().memory.contains(block.word(3), block.word(4))) return failed(block, kWindowsFault);
  return line_->isOpen() ? take(block) : 65;
}

int32_t Network::take(Block& block) {
  Buffer bytes;
  const size_t room = static_cast<size_t>(block.word(4)) * 4;
  const bool stream = protocol_ != Protocol::Udp;
  Received received = line_->receive(std::span(bytes).first(room), stream);
  // A stream is read in whole words; an incomplete word waits for its remaining bytes.
  if (stream && received.bytes >= 4)
    received = line_->receive(std::span(bytes).first(received.bytes / 4 * 4), false);
  else if (stream && received.bytes > 0)
    return 65;
  if (received.nothing) return 65;
  if (stream && received.error == 0 && received.bytes == 0) received.error = kWindowsDisconnected;
  if (received.error != 0) {
    line_->closeConnection();
    if (protocol_ != Protocol::Server) close();
    return failed(block, received.error);
  }
  for (size_t at = 0; at < received.bytes; at += 4) {
    uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min<size_t>(4, received.bytes - at));
    links().memory.setWord(static_cast<uint32_t>(block.word(3)) + static_cast<uint32_t>(at / 4),
                           static_cast<int32_t>(word));
  }
  if (block.amount() >= 4) block.setWord(5, 0);
  if (block.amount() >= 5)
    block.setWord(6, static_cast<int32_t>(isolated() || stream ? target_ : received.from.address));
  if (block.amount() >= 6) block.setWord(7, stream ? port_ : received.from.port);
  return 0;
}

std::optional<int32_t> Network::send(Block& block) {
  const PlcMemory& memory = links().memory;
  if (!memory.contains(block.word(3), block.word(4))) return failed(block, kWindowsFault);
  if (!line_->isOpen()) return 63; // a server without a client
  if (!flush()) return std::nullopt;
  Buffer bytes;
  const auto words = static_cast<uint32_t>(block.word(4));
  for (uint32_t i = 0; i < words; ++i) {
    const int32_t word = memory.word(static_cast<uint32_t>(block.word(3)) + i);
    std::memcpy(bytes.data() + size_t{4} * i, &word, sizeof word);
  }
  const std::span<const uint8_t> message(bytes.data(), size_t{4} * words);
  Endpoint to{target_, port_};
  if (block.amount() >= 5 && block.word(6) != 0) to.address = static_cast<uint32_t>(block.word(6));
  if (block.amount() >= 6 && block.word(7) > 0 && block.word(7) <= 65535)
    to.port = static_cast<uint16_t>(block.word(7));
  const bool udp = protocol_ == Protocol::Udp;
  const Sent sent = udp ? line_->sendTo(message, to) : line_->send(message);
  if (sent.error != 0) return failed(block, sent.error);
  if (sent.bytes == 0) return std::nullopt;
  unsentAt_ = 0;
  unsentBytes_ = udp ? 0 : message.size() - sent.bytes;
  std::memcpy(unsent_.data(), bytes.data() + message.size() - unsentBytes_, unsentBytes_);
  if (block.amount() >= 4) block.setWord(5, 0);
  return 0;
}

// Sends pending bytes. True: none is left.
bool Network::flush() {
  if (unsentBytes_ == 0) return true;
  const Sent sent = line_->send(std::span(unsent_).subspan(unsentAt_, unsentBytes_));
  if (sent.error != 0) close();
  unsentAt_ += sent.bytes;
  unsentBytes_ -= sent.bytes;
  return unsentBytes_ == 0;
}

void Network::cycle() {
  if (unsentBytes_ != 0) flush();
  if (isolated()) device_.poll();
}

// ---- configuration, events, quantities ---------------------------------------------------------------------------

Handled Network::config(std::string_view key, std::string_view value) {
  if (key != "network") return std::nullopt;
  close();
  line_ = value == "isolated" ? static_cast<Line*>(&control_) : &sockets_;
  return "";
}

Handled Network::event(std::string_view, const std::vector<NcArgument>& keys) {
  if (!isolated()) return "event device needs 'config network isolated'";
  line_->accept(); // so that a disconnected client is replaced by the next one
  return device_.event(keys, port_);
}

std::optional<double> Network::quantity(std::string_view name) const {
  if (!name.starts_with("DEVICE.")) return std::nullopt;
  device_.poll();
  if (name == "DEVICE.WORDS") return device_.receivedWords();
  if (name == "DEVICE.CONNECTED") return device_.connected() ? 1 : 0;
  const auto word = numbersAfter(name, "DEVICE.");
  if (!word || word->size() != 1) return std::nullopt;
  return device_.receivedWord((*word)[0]);
}

void Network::powerOn(nc::PowerOn) {
  close();
  device_.close();
}

// The simulated device on the network.

std::string NetworkDevice::open(std::string_view role, uint16_t port) {
  messageBytes_ = 0;
  udp_ = role == "udp";
  if (udp_) return line_.openUdp(port), "";
  if (role == "server") return line_.listen(port), "";
  if (role != "client") return "event device: open=\"udp\", \"server\" or \"client\"";
  return line_.connect({0, port}, 0) == 0 ? "" : "no server listens on port " + std::to_string(port);
}

// Sends as many words as `send` says; words that the event does not name are 0.
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
