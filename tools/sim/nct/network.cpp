// MW 60, 61, MR 62, MW 63 (see network.h).
#include "tools/sim/nct/network.h"

#include <algorithm>
#include <cstring>

namespace rung::sim::nct {
namespace {

constexpr int64_t kConnectUs = 5'000'000; // until a connection that nobody answers has failed
constexpr int32_t kWindowsTimeout = 10060;
constexpr int kSettleMs = 100; // on the virtual clock: the loopback needs no time of the program
constexpr uint32_t kHome = 0x7F000001;
constexpr uint32_t kControls = 0x7F400000; // 127.64.0.0/16 and 127.65.0.0/16: controls and their devices
constexpr uint32_t kDevices = 0x7F410000;

} // namespace

bool Network::serves(bool write, uint32_t function) const {
  return write ? function == 60 || function == 61 || function == 63 : function == 62;
}

std::optional<int32_t> Network::service(uint32_t function, Block& block) {
  const int32_t amount = block.amount();
  const bool data = function == 62 || function == 63;
  // The table has words up to 7, the text amounts up to 5: 6 reaches the port (l.4029).
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
  acceptClient();
  if (protocol_ == Protocol::None || connecting_) return 63;
  if (function == 62) return receive(block);
  return send(block);
}

// ---- addresses ---------------------------------------------------------------------------------------------------

// While this process holds the guard's port, no other control has it: two free addresses of the loopback follow.
void Network::claimAddress() {
  if (ownAddress_ != 0) return;
  if (!isolated()) {
    ownAddress_ = deviceAddress_ = kHome;
    return;
  }
  guard_.openUdp({kHome, 0});
  ownAddress_ = kControls | guard_.port();
  deviceAddress_ = kDevices | guard_.port();
}

Endpoint Network::reachable(Endpoint target) const {
  return isolated() ? Endpoint{deviceAddress_, target.port} : target;
}

// ---- opening and closing -----------------------------------------------------------------------------------------

std::optional<int32_t> Network::open(Block& block) {
  if (connecting_) return connecting(block);
  const int32_t protocol = block.word(4);
  const auto address = static_cast<uint32_t>(block.word(5));
  const int32_t port = block.word(6);
  if (protocol < 1 || protocol > 3 || address == 0 || address == 0xFFFFFFFF || port < 1 || port > 65535) return 66;
  close();
  claimAddress();
  target_ = address;
  port_ = static_cast<uint16_t>(port);
  int32_t error = 0;
  if (protocol == 1) error = socket_.openUdp(own());
  if (protocol == 2) error = listener_.listen(own());
  if (protocol == 3) error = socket_.connect({ownAddress_, 0}, reachable({address, port_}));
  if (error != 0) {
    block.setWord(3, error);
    return 61;
  }
  protocol_ = static_cast<Protocol>(protocol);
  connecting_ = protocol_ == Protocol::Client;
  connectingSince_ = links().nowUs;
  block.setWord(3, 0);
  if (!connecting_) return 0;
  if (!links().realTime) socket_.writable(kSettleMs);
  return connecting(block);
}

std::optional<int32_t> Network::connecting(Block& block) {
  std::optional<int32_t> error = socket_.connected();
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
  listener_.close();
  socket_.close();
  unsentBytes_ = unsentAt_ = 0;
}

// A server's client, or the next one when the last has gone.
void Network::acceptClient() {
  if (protocol_ == Protocol::Server && !socket_.isOpen()) socket_ = listener_.accept();
}

// ---- data --------------------------------------------------------------------------------------------------------

// A word of the answer goes only where the program's block reaches: optional data (l.4034).
int32_t Network::failed(Block& block, int32_t error) {
  if (block.amount() >= 4) block.setWord(5, error);
  return 62;
}

int32_t Network::receive(Block& block) {
  // Word 0000 is the program's flags.
  if (block.word(3) < 1 || !links().memory.contains(block.word(3), block.word(4))) return failed(block, kWindowsFault);
  return socket_.isOpen() ? receiveFrom(block, socket_) : 65;
}

int32_t Network::receiveFrom(Block& block, Socket& socket) {
  Buffer bytes;
  const size_t room = static_cast<size_t>(block.word(4)) * 4;
  const bool stream = protocol_ != Protocol::Udp;
  Socket::Received received = socket.receive(std::span(bytes).first(room), stream);
  // A stream is taken word by word; what is left of a word waits for the rest.
  if (stream && received.bytes >= 4)
    received = socket.receive(std::span(bytes).first(received.bytes / 4 * 4));
  else if (stream && received.bytes > 0)
    return 65;
  if (received.nothing) return 65;
  if (stream && received.error == 0 && received.bytes == 0) received.error = kWindowsDisconnected;
  if (received.error != 0) {
    socket.close();
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
  if (!socket_.isOpen()) return 63; // a server without a client
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
  const Socket::Sent sent = udp ? socket_.sendTo(message, reachable(to)) : socket_.send(message);
  if (sent.error != 0) return failed(block, sent.error);
  if (sent.bytes == 0) return std::nullopt;
  unsentAt_ = 0;
  unsentBytes_ = udp ? 0 : message.size() - sent.bytes;
  std::memcpy(unsent_.data(), bytes.data() + message.size() - unsentBytes_, unsentBytes_);
  if (block.amount() >= 4) block.setWord(5, 0);
  return 0;
}

// True: nothing is left.
bool Network::flush() {
  if (unsentBytes_ == 0) return true;
  const Socket::Sent sent = socket_.send(std::span(unsent_).subspan(unsentAt_, unsentBytes_));
  if (sent.error != 0) close();
  unsentAt_ += sent.bytes;
  unsentBytes_ -= sent.bytes;
  return unsentBytes_ == 0;
}

void Network::cycle() {
  if (unsentBytes_ != 0) flush();
}

// ---- configuration, events, quantities ---------------------------------------------------------------------------

Handled Network::config(std::string_view key, std::string_view value) {
  if (key != "network") return std::nullopt;
  isolated_ = value == "isolated";
  return "";
}

// What the device has done is there for the control before the next scan.
Handled Network::event(std::string_view name, const std::vector<NcArgument>& keys) {
  if (name != "device") return std::nullopt;
  if (!isolated()) return "event device needs 'config network isolated'";
  claimAddress();
  std::string wrong = device_.event(keys, {deviceAddress_, port_}, own());
  if (!wrong.empty()) return wrong;
  if (findKey(keys, "send") != nullptr) {
    listener_.readable(socket_.isOpen() ? 0 : kSettleMs);
    acceptClient();
    if (socket_.isOpen()) socket_.readable(kSettleMs);
  }
  if (const NcArgument* role = findKey(keys, "open"); role != nullptr && role->text == "client") {
    listener_.readable(kSettleMs);
    acceptClient();
  }
  if (findKey(keys, "close") != nullptr && socket_.isOpen() && protocol_ != Protocol::Udp) socket_.readable(kSettleMs);
  return "";
}

std::optional<double> Network::quantity(std::string_view name) const {
  if (name == "DEVICE.WORDS") return device_.receivedWords();
  if (name == "DEVICE.CONNECTED") return device_.connected() ? 1 : 0;
  const auto word = numbersBehind(name, "DEVICE.");
  if (!word || word->size() != 1) return std::nullopt;
  return device_.receivedWord((*word)[0]);
}

void Network::powerOn(nc::PowerOn) {
  close();
  device_.close();
}

} // namespace rung::sim::nct
