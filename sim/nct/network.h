// The other side of the simulated network: a device that scenarios open, close and make send (`event device …`).
#pragma once
#include <array>
#include <string>
#include <vector>

#include "sim/nct/memory_line.h"
#include "sim/nct/socket.h"
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

// The network of the PLC program: MW 60, 61, MR 62, MW 63 (man. 6.22), UDP and TCP.
//
// `config network isolated` (default): a network in memory, of the control and the simulated device alone; whatever
// target a program names is the device. `config network loopback`: the control is 127.0.0.1 and reaches other programs
// on 127.0.0.0/8 by their addresses and ports, through real sockets that are only looked at between two scans. They
// never wait, but for 100 ms when a connection is opened on the virtual clock.

class Network final : public Topic {
public:
  explicit Network(Links& links) : Topic(links) { MemoryLine::join(control_, remote_); }

  bool serves(bool write, uint32_t function) const override;
  std::optional<int32_t> service(uint32_t function, Block& block) override;
  Handled config(std::string_view key, std::string_view value) override;
  std::span<const std::string_view> events() const override {
    static constexpr std::string_view kEvents[] = {"device"};
    return kEvents;
  }
  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;
  void powerOn(nc::PowerOn kind) override;
  void cycle() override;
  void dropRequests() override { close(); }

private:
  enum class Protocol : uint8_t { None, Udp, Server, Client };
  using Buffer = std::array<uint8_t, kMostNetworkBytes>;

  std::optional<int32_t> open(Block& block);
  std::optional<int32_t> connecting(Block& block);
  int32_t receive(Block& block);
  int32_t take(Block& block);
  std::optional<int32_t> send(Block& block);
  int32_t failed(Block& block, int32_t error);
  void close();
  bool flush();
  bool isolated() const { return line_ == &control_; }

  MemoryLine control_; // the two sides of the network in memory
  MemoryLine remote_;
  SocketLine sockets_;
  Line* line_ = &control_; // where the program's connection leads

  Protocol protocol_ = Protocol::None; // of the connection
  bool connecting_ = false;
  int64_t connectingSince_ = 0;
  uint32_t target_ = 0; // as the program wrote it
  uint16_t port_ = 0;
  Buffer unsent_{}; // of a stream that had no room
  size_t unsentBytes_ = 0;
  size_t unsentAt_ = 0;
  mutable NetworkDevice device_{remote_};
};

} // namespace rung::sim::nct
