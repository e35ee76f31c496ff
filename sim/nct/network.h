// The network of the PLC program: MW 60, 61, MR 62, MW 63 (man. 6.22), UDP and TCP.
//
// `config network isolated` (default): a network in memory, of the control and the simulated device alone; whatever
// target a program names is the device. `config network loopback`: the control is 127.0.0.1 and reaches other programs
// on 127.0.0.0/8 by their addresses and ports, through real sockets that are only looked at between two scans. They
// never wait, but for 100 ms when a connection is opened on the virtual clock.
#pragma once
#include <array>

#include "sim/nct/network_device.h"
#include "sim/nct/socket_line.h"

namespace rung::sim::nct {

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
